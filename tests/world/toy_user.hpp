// A car on rails, for the tests of who is where on a lane.
#pragma once

#include "tests/support/toy_drivers.hpp"

namespace sofof::toy {

inline constexpr double front_m = 4.0175, rear_m = 1.0825;

inline world::road_user user(station_id station, world::route_ptr on,
                             double s_m) {
  return make_rider(station, std::move(on), s_m).user;
}

} // namespace sofof::toy
