// CODM "edf": every result of every service is to be in time.
#include "base/options/option_helpers.hpp"
#include "base/protocol.hpp"
#include "policies/algorithms/scheduling/placement.hpp"
#include "policies/entry.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace sofof::policies {

namespace {

constexpr std::array<std::string_view, 3> tests{"utilisation", "demand",
                                                "phases"};

admission_test test_of(std::string_view name) {
  const auto found = std::ranges::find(tests, name);
  return static_cast<admission_test>(found - tests.begin());
}

/// Accepts a service if some worker keeps all deadlines with it,
/// earliest deadline first; of these workers the one with most room. Sessions
/// that run keep their workers and offsets. Of the time limit of a service, a
/// part goes to the network.
///
/// Which test a worker must pass: "phases" assigns each service its offset in
/// the period, so that they do not wait for each other; "demand" is the exact
/// test for services that may begin together; "utilisation" does not look at
/// deadlines and breaks those shorter than periods, to compare with.
///
/// All this is about workers of their own with preemption, as the tests have
/// it. The provider's take jobs as they come, whichever is free: what waits for
/// nothing on its own worker ("phases" with room) waits for nothing there
/// either, all else is as near as the jobs are alike.
///
/// Source: Liu & Layland 1973; Baruah, Rosier & Howell 1990; phases are ours.
class edf final : public central_policy {
public:
  std::vector<central_decision> decide(const central_context& context) override;
  void visit_options(option_visitor& s) override;
  std::string_view name() const override { return "edf"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<edf>(*this);
  }

private:
  periodic_task to_schedule(const periodic_task& told) const;

  std::string test_ = "phases";
  duration network_ = std::chrono::milliseconds{30};
  double margin_ = 0.1; // of the computing time, to be safe
};

periodic_task edf::to_schedule(const periodic_task& told) const {
  auto task = told;
  task.wcet = from_seconds(to_seconds(told.wcet) * (1 + margin_));
  task.deadline -= network_;
  return task;
}

std::vector<central_decision> edf::decide(const central_context& context) {
  std::vector<std::vector<periodic_task>> workers(context.workers);
  for (const auto& session : context.sessions)
    workers[std::min(session.worker, context.workers - 1)].push_back(
        to_schedule(session.task));
  std::vector<central_decision> all;
  for (const auto& request : context.requests) {
    auto task = to_schedule(request.task);
    const auto test = test_of(test_);
    if (const auto first = task.period + task.deadline;
        test == admission_test::phases && first > protocol::start_timeout) {
      all.push_back({refused{},
                     {"its first result would come too late", to_seconds(first),
                      to_seconds(protocol::start_timeout), "s"}});
      continue;
    }
    const auto place = worst_fit(workers, task, test);
    if (!place) {
      all.push_back({refused{}, "no worker keeps all deadlines"});
      continue;
    }
    task.offset = place->offset;
    workers[place->core].push_back(task);
    accepted terms{.worker = place->core};
    if (test == admission_test::phases)
      terms.offset = place->offset;
    all.push_back({terms, "all deadlines are kept"});
  }
  return all;
}

void edf::visit_options(option_visitor& s) {
  visit_word(s, "test", test_, "test", tests);
  s.field("network", network_, duration{0});
  s.field("margin", margin_, {0, 10});
}

} // namespace

codm_entry codm_edf() {
  return {{"edf",
           "Accepts as long as every result can be in time.",
           "sum_j (floor((t - D_j) / T_j) + 1) C_j <= t for all deadlines t up "
           "to the busy period (demand); or an offset in the period for which "
           "no deadline is missed (phases)",
           "period, computing time, time limit and offset of all that runs",
           "Baruah et al., Real-Time Systems 2(4), 1990; phases are ours",
           {{"test", "\"phases\", \"demand\" or \"utilisation\"",
             "that a worker must pass"},
            {"network", "time", "part of the time limit that the way takes"},
            {"margin", "1", "part of the computing time added, to be safe"}}},
          filtered_by_request<edf>};
}

} // namespace sofof::policies
