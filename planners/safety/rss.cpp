// Distances that are safe are quadratic in the response time.
#include "planners/safety/rss.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {

double farthest_m(double speed_mps, double response_s, const rss_motion& of) {
  assert(response_s >= 0 && of.brake_min_mps2 > 0);
  const auto then_mps =
      std::max(0.0, speed_mps + of.accel_max_mps2 * response_s);
  const auto way_m =
      response_s * (speed_mps + 0.5 * of.accel_max_mps2 * response_s);
  return std::max(0.0, way_m + then_mps * then_mps / (2 * of.brake_min_mps2));
}

// With a, b: v ρ + a ρ²/2 + (v + a ρ)²/(2 b) = room. Its greater root is one
// with v + a ρ > 0, also if v < 0.
double longest_response_s(double speed_mps, double room_m,
                          const rss_motion& of) {
  const auto a = of.accel_max_mps2, b = of.brake_min_mps2;
  assert(a > 0 && b > 0 && std::isfinite(speed_mps));
  const auto stops_m = speed_mps > 0 ? speed_mps * speed_mps / (2 * b) : 0.0;
  if (!(room_m >= stops_m))
    return -1;
  const auto square = 0.5 * a * (1 + a / b);
  const auto linear = speed_mps * (1 + a / b);
  const auto constant = speed_mps * speed_mps / (2 * b) - room_m;
  const auto root = linear * linear - 4 * square * constant;
  assert(root >= 0);
  return (std::sqrt(root) - linear) / (2 * square);
}

double follows_safely_s(const rss_gap& x, const rss_motion& lon) {
  assert(x.other_mps >= 0 && lon.brake_max_mps2 >= lon.brake_min_mps2);
  if (x.gap_m < 0)
    return -1;
  const auto goes_on_m = x.other_mps * x.other_mps / (2 * lon.brake_max_mps2);
  return longest_response_s(x.own_mps, x.gap_m + goes_on_m, lon);
}

double meets_safely_s(const rss_gap& x, const rss_motion& of,
                      double others_response_s) {
  assert(others_response_s >= 0);
  if (x.gap_m < 0)
    return -1;
  const auto other_m = farthest_m(x.other_mps, others_response_s, of);
  return longest_response_s(x.own_mps, x.gap_m - other_m, of);
}

} // namespace sofof::planners
