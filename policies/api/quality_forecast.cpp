// What results of a provider will be like where a vehicle is going.
#include "policies/api/quality_forecast.hpp"

#include <cassert>

namespace sofof::policies {

std::vector<forecast_point> forecast_along(const quality_forecast& source,
                                           provider_id provider,
                                           std::string_view service,
                                           std::span<const point> path,
                                           double speed_mps) {
  assert(speed_mps >= 0);
  const auto fast_mps = std::max(speed_mps, least_forecast_mps);
  std::vector<forecast_point> along;
  double way_m = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0)
      way_m += distance_m(path[i - 1], path[i]);
    const auto in_s = way_m / fast_mps;
    if (in_s > forecast_span_s)
      break;
    const auto there = source.look(provider, service, path[i]);
    assert(there.late >= 0 && there.late <= 1 && there.latency_s >= 0);
    along.push_back({in_s, there.late, there.latency_s});
  }
  return along;
}

} // namespace sofof::policies
