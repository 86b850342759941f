// Where a sensor stands and how far it looks.
#pragma once

#include "base/geometry.hpp"

namespace sofof {

/// The place and the field of view of a sensor at one moment.
struct viewpoint {
  point at;                       ///< m, east-north.
  double heading_rad = 0;         ///< Of the middle of the field of view.
  double range_m = 0;             ///< 0: not known.
  double field_of_view_deg = 360; ///< Round its heading.
};

} // namespace sofof
