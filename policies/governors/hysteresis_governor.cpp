// Governor "hysteresis": no hasty changes of where a service runs.
#include "policies/governors/hysteresis_governor.hpp"

namespace sofof {

local_decision hysteresis_governor::govern(const local_context& context,
                                           const local_decision& wanted) {
  auto i = services_.find(context.kind);
  if (i == services_.end())
    i = services_.emplace(context.kind, hysteresis{options_}).first;
  auto& service = i->second;
  service.is_at(context.current, context.since);
  if (wanted.release) {
    service.next({hysteresis::local, 0, true}, context.now);
    return wanted;
  }
  const auto source = wanted.source != 0 ? wanted.source : context.current;
  const auto next = service.next({source, wanted.advantage}, context.now);
  if (next == source)
    return wanted;
  auto decision = as_it_is("not for long enough");
  if (context.current != 0) { // else it would be the first
    decision.second = wanted.second;
    decision.hedge_after = wanted.hedge_after;
  }
  return decision;
}

void hysteresis_governor::visit_options(option_visitor& s) {
  s.field("margin", options_.margin, {0, 1e3});
  s.field("time_to_trigger", options_.time_to_trigger, duration{0});
  s.field("min_dwell", options_.dwell, duration{0});
  s.field("epoch_s", epoch_s_, {1e-3, 3600});
}

} // namespace sofof
