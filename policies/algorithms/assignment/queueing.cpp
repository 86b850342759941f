// How long a job waits at a busy provider, and how busy it may be.
#include "policies/algorithms/assignment/queueing.hpp"

namespace sofof::assignment {

std::optional<duration> mean_wait(duration service_time, double utilisation) {
  if (utilisation >= 1)
    return std::nullopt;
  return from_seconds(utilisation * to_seconds(service_time)
                      / (2 * (1 - utilisation)));
}

double utilisation_cap(int cores, duration service_time,
                       duration allowed_wait) {
  const auto twice = 2 * to_seconds(allowed_wait);
  return cores * twice / (to_seconds(service_time) + twice);
}

} // namespace sofof::assignment
