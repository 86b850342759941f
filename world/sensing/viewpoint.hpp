// Where a sensor stands and how far it looks.
#pragma once

#include "base/geometry.hpp"

namespace sofof::world {

/// The place and the field of view of a sensor at one moment.
struct viewpoint {
  point at;                       ///< m, east-north.
  double heading_rad = 0;         ///< Of the middle of the field of view.
  double range_m = 0;             ///< 0: not known.
  double field_of_view_deg = 360; ///< Round its heading.
};

void visit_fields(auto& v, viewpoint& x) {
  v("at", x.at);
  v("heading_rad", x.heading_rad);
  v("range_m", x.range_m);
  v("field_of_view_deg", x.field_of_view_deg);
}

} // namespace sofof::world
