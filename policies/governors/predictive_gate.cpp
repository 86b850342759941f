// Governor "predictive_gate": offloads only where results will be in time.
#include "policies/algorithms/forecast/predictive_gate.hpp"

#include "policies/entry.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sofof::policies {

namespace {

constexpr std::string_view late_results = "late results are likely";
constexpr std::string_view late_place = "late results are likely ahead";

/// A gate for each service and provider on the forecast that its next result is
/// late, and on that for the places ahead, where there is one. A provider whose
/// gate is closed is not asked, and a service that runs there comes home,
/// unless it has just begun and there is no forecast yet. It comes home before
/// a bad place is there, and does not go for less time than `begin_before`.
class predictive_gate_governor final : public governor {
public:
  local_decision govern(const local_context& context,
                        const local_decision& wanted) override;
  double epoch_s() const override { return epoch_s_; }
  bool needs_forecast() const override {
    return leave_before_ > duration{0} || begin_before_ > duration{0};
  }
  bool foresees_home(const local_context& context) const override;
  void visit_options(option_visitor& s) override;
  std::string_view name() const override { return "predictive_gate"; }
  std::unique_ptr<governor> clone() const override {
    return std::make_unique<predictive_gate_governor>(*this);
  }

private:
  /// Which providers are not to be asked, and whether one where it runs ends.
  struct closed_gates {
    std::vector<provider_id> at;
    std::string_view ends; // why; empty: it goes on

    bool holds(provider_id id) const {
      return std::ranges::find(at, id) != at.end();
    }
  };

  bool open(const local_context& context, const provider_view& provider);
  bool is_late_ahead(const local_context& context, provider_id provider,
                     duration before) const;
  closed_gates look(const local_context& context);

  double on_ = 0.005;
  double off_ = 0.02;
  double epoch_s_ = 0.1;
  double most_late_ = 0.2;
  duration leave_before_ = std::chrono::seconds{1};
  duration begin_before_ = std::chrono::seconds{3};
  std::map<std::pair<std::string, provider_id>, predictive_gate> gates_;
};

bool predictive_gate_governor::open(const local_context& context,
                                    const provider_view& provider) {
  auto& gate =
      gates_.try_emplace({std::string{context.service}, provider.id}, on_, off_)
          .first->second;
  return gate.update(provider.link.late);
}

bool predictive_gate_governor::is_late_ahead(const local_context& context,
                                             provider_id provider,
                                             duration before) const {
  return before > duration{0}
         && late_within(forecast_of(context.forecasts, provider),
                        to_seconds(before))
                > most_late_;
}

predictive_gate_governor::closed_gates
predictive_gate_governor::look(const local_context& context) {
  closed_gates closed;
  for (const auto& provider : context.providers) { // all gates look on
    const auto runs = provider.id == context.current;
    const auto is_open = open(context, provider);
    const auto is_bad = is_late_ahead(context, provider.id,
                                      runs ? leave_before_ : begin_before_);
    if (is_open && !is_bad)
      continue;
    closed.at.push_back(provider.id);
    if (runs && is_bad)
      closed.ends = late_place;
    else if (runs && provider.link.median)
      closed.ends = late_results;
  }
  return closed;
}

bool predictive_gate_governor::foresees_home(
    const local_context& context) const {
  return context.current
         && is_late_ahead(context, *context.current,
                          std::max(leave_before_, begin_before_));
}

local_decision predictive_gate_governor::govern(const local_context& context,
                                                const local_decision& wanted) {
  const auto closed = look(context);
  const auto ends = !closed.ends.empty();
  if (std::holds_alternative<come_home>(wanted.what))
    return ends ? local_decision{come_home{}, closed.ends} : wanted;
  auto second = second_of(wanted);
  if (second && closed.holds(second->provider))
    second.reset();
  const auto* there = std::get_if<run_at>(&wanted.what);
  const auto moves = there && there->provider != context.current;
  if (moves && !closed.holds(there->provider))
    return with_second(wanted, second);
  if (ends && !second)
    return {come_home{}, closed.ends};
  if (ends) // the other one is fine
    return {run_at{.provider = second->provider,
                   .advantage = there ? there->advantage : 1},
            wanted.why};
  const auto is_bad =
      moves && is_late_ahead(context, there->provider, begin_before_);
  return moves
             ? with_second(as_it_is(is_bad ? late_place : late_results), second)
             : with_second(wanted, second);
}

void predictive_gate_governor::visit_options(option_visitor& s) {
  s.field("on", on_, {0, 1});
  s.field("off", off_, {0, 1});
  if (off_ < on_)
    s.refuse("off", "must not be less than `on`.");
  s.field("epoch_s", epoch_s_, {1e-3, 3600});
  s.field("most_late", most_late_, {0, 1});
  s.field("leave_before", leave_before_, duration{0});
  s.field("begin_before", begin_before_, duration{0});
  for (const auto& [key, time] : {std::pair{"leave_before", leave_before_},
                                  std::pair{"begin_before", begin_before_}})
    if (to_seconds(time) > forecast_span_s)
      s.refuse(key, "must not be more than \"10s\": so far forecasts reach.");
}

} // namespace

governor_entry governor_predictive_gate() {
  return {
      {"predictive_gate",
       "Offloads only where results will be in time.",
       "P(latency > limit) <= on to go there, > off to come home; no bad place "
       "ahead",
       "latencies of what came from each provider; a forecast by place, if "
       "there is one",
       "Wodtko et al., IV 2025, for the forecast; the gate is ours",
       {{"on", "1", "probability to be late up to which a provider is asked"},
        {"off", "1", "probability above which the service comes home"},
        {"epoch_s", "s", "between two looks"},
        {"most_late", "1",
         "probability of late results at a place that is bad above it"},
        {"leave_before", "s",
         "so long before a bad place the service comes home; 0: not before"},
        {"begin_before", "s",
         "with one nearer than this nobody is asked; 0: however near"}}},
      unfiltered<governor, predictive_gate_governor>};
}

} // namespace sofof::policies
