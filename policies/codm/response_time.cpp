// CODM "response_time": a further session must not make anybody's results late.
#include "policies/algorithms/scheduling/response_time.hpp"

#include "base/protocol.hpp"
#include "base/random_phase.hpp"
#include "policies/entry.hpp"

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

namespace sofof::policies {

namespace {

/// Whether there is time to wait for the phase before the first result is due.
bool keeps_phase(const periodic_task& task) {
  return task.period + task.deadline <= protocol::start_timeout
         && task.jitter == duration{0};
}

/// What runs, grouped by how it computes.
class session_mix {
public:
  void add(periodic_task task) {
    if (!keeps_phase(task))
      task.jitter = std::max(task.jitter, jitter_with_first_cycle(task.period));
    const auto key = [](const periodic_task& t) {
      return std::tuple{t.wcet, t.period, t.deadline, t.jitter};
    };
    const auto found =
        std::ranges::find(groups_, key(task), [&](const session_group& group) {
          return key(group.task);
        });
    if (found != groups_.end())
      ++found->count;
    else
      groups_.push_back({task, 1});
  }

  const std::vector<session_group>& groups() const { return groups_; }

private:
  std::vector<session_group> groups_;
};

/// Accepts a session if the longest response of every session that runs, and of
/// this one, leaves the network its part of the time limit. Where computing
/// times have no end, the response is one that all but few results keep. Of
/// requests that come together, first come, first served.
///
/// It assigns a phase, drawn, so that the first cycle waits for it: without,
/// two cycles of each session might come together.
class response_time final : public central_policy {
public:
  std::vector<central_decision> decide(const central_context& context) override;
  void visit_options(option_visitor& s) override {
    s.field("network", network_, duration{0});
    s.field("late", late_, {0, 1});
  }
  std::string_view name() const override { return "response_time"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<response_time>(*this);
  }

private:
  /// What is said of a mix; `why` tells of the session with the least room.
  struct judgement {
    bool fits = false;
    reason why;
  };
  judgement judge(const session_mix& mix, std::size_t workers) const;

  duration network_ = std::chrono::milliseconds{30};
  double late_ = 0.01; // share of results that may be later, if any may
};

response_time::judgement response_time::judge(const session_mix& mix,
                                              std::size_t workers) const {
  const auto all = stated_responses(mix.groups(), workers);
  if (!all)
    return {false, "response times would have no bound"};
  judgement of_all{true, {}};
  auto least = duration::max();
  for (std::size_t i = 0; i < all->size(); ++i) {
    const auto& [at_most, later] = (*all)[i];
    if (later > late_)
      return {false, {"too many results could be late", later, late_}};
    const auto limit = mix.groups()[i].task.deadline - network_;
    if (limit - at_most >= least)
      continue;
    least = limit - at_most;
    const auto fits = at_most <= limit;
    of_all = {fits,
              {fits ? "every response is in time" : "a response could be late",
               to_seconds(at_most), to_seconds(limit), "s"}};
  }
  return of_all;
}

std::vector<central_decision>
response_time::decide(const central_context& context) {
  session_mix running;
  for (const auto& session : context.sessions)
    running.add(session.at_most);
  std::vector<central_decision> all;
  for (const auto& request : context.requests) {
    auto with = running;
    with.add(request.at_most);
    const auto [fits, why] = judge(with, context.workers);
    if (!fits) {
      all.push_back({refused{}, why});
      continue;
    }
    running = std::move(with);
    accepted terms;
    if (const auto& task = request.at_most; keeps_phase(task))
      terms.offset = random_phase(
          context.noise.part(request.service).part(request.station.value()),
          task.period);
    all.push_back({terms, why});
  }
  return all;
}

} // namespace

codm_entry codm_response_time() {
  return {
      {"response_time",
       "Accepts as long as every response time is bounded in time.",
       "R_i <= D_i - network for all that runs and is asked for; R_i is the "
       "worst case of a queue before all workers, first come, first served",
       "period, longest computing time and time limit of all that runs",
       "George & Minet, ICDCS 1997; Guan et al., RTSS 2008",
       {{"network", "time", "part of the time limit that the way takes"},
        {"late", "1",
         "share of results that may be later, where computing times have "
         "no end"}}},
      filtered_by_request<response_time>};
}

} // namespace sofof::policies
