// What many drives of these tests have in common.
#pragma once

#include "tests/planners/test_drive.hpp"

#include <vector>

namespace sofof::test {

inline const planners::comfort_limits style;

/// Limits as in a town, and beyond its end.
inline const std::vector<world::speed_zone> town{
    {0, 13.9}, {120, 8.3}, {200, 13.9}, {500, 19.4}};

inline const time_point now{from_seconds(100)};

/// @returns who drives in the middle of its lane now, and knows of nobody.
inline planners::planning_input driving(double s_m, double speed_mps) {
  planners::planning_input x;
  x.at = now;
  x.others.at = now;
  x.s_m = s_m;
  x.speed_mps = speed_mps;
  return x;
}

inline test_drive optimal(const world::route_ptr& way, double s_m,
                          double speed_mps,
                          const planners::spatial_params& params = {}) {
  return {way, s_m, speed_mps, optimiser(way, params)};
}

} // namespace sofof::test
