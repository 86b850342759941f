// Both follow from the limits of the service that plans.
#include "scenario/plan_limits.hpp"

#include <algorithm>
#include <chrono>

namespace sofof::scenario {

duration fresh_limit(const scenario_definition& s) {
  const auto* planning = planning_service(s);
  if (!planning)
    return {};
  const auto& options = planning->options;
  return options.limits.max_latency + options.limits.max_interarrival
         + options.period;
}

duration alone_limit(const scenario_definition& s) {
  return planning_service(s)
             ? std::max<duration>(std::chrono::seconds{1}, 3 * fresh_limit(s))
             : duration{};
}

} // namespace sofof::scenario
