// How long a job waits at a busy provider, and how busy it may be.
#include "policies/algorithms/assignment/queueing.hpp"

#include <cassert>

namespace sofof::policies::assignment {

std::optional<duration> mean_wait(duration service_time, double utilisation) {
  assert(service_time >= duration{0} && utilisation >= 0);
  if (utilisation >= 1)
    return std::nullopt;
  return from_seconds(utilisation * to_seconds(service_time)
                      / (2 * (1 - utilisation)));
}

double utilisation_cap(int cores, duration service_time,
                       duration allowed_wait) {
  assert(cores >= 0 && allowed_wait >= duration{0});
  const auto twice = 2 * to_seconds(allowed_wait);
  return cores * twice / (to_seconds(service_time) + twice);
}

} // namespace sofof::policies::assignment
