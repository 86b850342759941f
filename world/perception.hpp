// What sensors tell of the road: bodies without names.
#pragma once

#include "world/geometry.hpp"
#include "world/time.hpp"

namespace sofof {

/// A body that a sensor has seen, as a perceived object of a CPM describes it.
struct perceived_object {
  point centre;           ///< Of its body, m, east-north.
  double heading_rad = 0; ///< Of its long axis, forward.
  double speed_mps = 0;   ///< Along its heading.
  double accel_mps2 = 0;  ///< Along its heading.
  double length_m = 0;
  double width_m = 0;
};

} // namespace sofof
