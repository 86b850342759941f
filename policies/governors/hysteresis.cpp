// Governor "hysteresis": no hasty changes of where a service runs.
#include "policies/algorithms/switching/hysteresis.hpp"

#include "policies/entry.hpp"

#include <map>
#include <string>

namespace sofof::policies {

namespace {

/// Lets a service go to a provider only when that was wanted for a while, and
/// not soon after it came home or somewhere else. What comes home is never
/// kept.
class hysteresis_governor final : public governor {
public:
  local_decision govern(const local_context& context,
                        const local_decision& wanted) override;
  void visit_options(option_visitor& s) override;
  double epoch_s() const override { return epoch_s_; }
  std::string_view name() const override { return "hysteresis"; }
  std::unique_ptr<governor> clone() const override {
    return std::make_unique<hysteresis_governor>(*this);
  }

private:
  hysteresis_options options_;
  double epoch_s_ = 0.1;
  std::map<std::string, hysteresis, std::less<>> services_;
};

local_decision hysteresis_governor::govern(const local_context& context,
                                           const local_decision& wanted) {
  auto i = services_.find(context.service);
  if (i == services_.end())
    i = services_.emplace(context.service, hysteresis{options_}).first;
  auto& service = i->second;
  service.is_at(context.current, context.since);
  if (std::holds_alternative<come_home>(wanted.what)) {
    service.next({.must_fall_back = true}, context.now);
    return wanted;
  }
  hysteresis::wish wish{.source = context.current, .advantage = 1};
  if (const auto* there = std::get_if<run_at>(&wanted.what))
    wish = {.source = there->provider, .advantage = there->advantage};
  if (service.next(wish, context.now) == wish.source)
    return wanted;
  auto decision = as_it_is("not for long enough");
  return context.current ? with_second(decision, second_of(wanted)) : decision;
}

void hysteresis_governor::visit_options(option_visitor& s) {
  s.field("margin", options_.margin, {0, 1e3});
  s.field("time_to_trigger", options_.time_to_trigger, duration{0});
  s.field("min_dwell", options_.dwell, duration{0});
  s.field("epoch_s", epoch_s_, {1e-3, 3600});
}

} // namespace

governor_entry governor_hysteresis() {
  return {
      {"hysteresis",
       "No hasty changes of where a service runs.",
       "advantage > margin for time_to_trigger without a break, and the last "
       "change is min_dwell ago; who comes home is never kept",
       "what the policy wants",
       "event A3 of 3GPP TS 36.331, with a dwell in addition",
       {{"margin", "1", "an advantage counts above this, as normalised gain"},
        {"time_to_trigger", "time", "so long must it last"},
        {"min_dwell", "time", "between two changes"},
        {"epoch_s", "s", "between two looks"}}},
      unfiltered<governor, hysteresis_governor>};
}

} // namespace sofof::policies
