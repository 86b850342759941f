// A body on the road as it really is: a vehicle, or what stands in its way.
#pragma once

#include "base/geometry.hpp"
#include "base/ids.hpp"

namespace sofof::world {

struct road_body {
  station_id id = 0; ///< No two are the same.
  oriented_box box;
  double speed_mps = 0;  ///< Along its heading.
  double accel_mps2 = 0; ///< Along its heading.
};

} // namespace sofof::world
