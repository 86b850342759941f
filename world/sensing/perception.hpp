// What a driver is told of the road: bodies without names, and where to wait.
#pragma once

#include "base/geometry.hpp"
#include "base/time.hpp"

#include <optional>
#include <vector>

namespace sofof::world {

/// A body that a sensor has seen, as a perceived object of a CPM describes it.
struct perceived_object {
  point centre;           ///< Of its body, m, east-north.
  double heading_rad = 0; ///< Where its front is.
  double speed_mps = 0;   ///< Along its heading.
  double accel_mps2 = 0;  ///< Along its heading.
  double length_m = 0;
  double width_m = 0;
};

void visit_fields(auto& v, perceived_object& x) {
  v("centre", x.centre);
  v("heading_rad", x.heading_rad);
  v("speed_mps", x.speed_mps);
  v("accel_mps2", x.accel_mps2);
  v("length_m", x.length_m);
  v("width_m", x.width_m);
}

/// What a driver has to know about the others.
struct perception {
  time_point at;
  /// The front bumper must not pass this arc length on the own route: a
  /// crossing has not been granted yet. Empty where nobody is granted
  /// anything.
  std::optional<double> stop_at_m;
  /// What the own sensors see, in the order of `scene::seen_by`. The traffic
  /// leaves it empty; the road fills it in.
  std::vector<perceived_object> objects;
};

void visit_fields(auto& v, perception& x) {
  v("at", x.at);
  v("stop_at_m", x.stop_at_m);
  v("objects", x.objects);
}

} // namespace sofof::world
