// What a scenario says of bodies on its road that nobody drives.
#pragma once

#include "base/geometry.hpp"
#include "base/options/option_helpers.hpp"
#include "world/traffic/scripted_body.hpp"

#include <algorithm>
#include <vector>

namespace sofof::scenario {

/// Where a body is at one moment, and how it moves.
struct obstacle_moment {
  double t_s = 0;         ///< After the run's start.
  point position_m;       ///< Of its middle.
  double heading_deg = 0; ///< Along its length, counter-clockwise from east.
  double speed_mps = 0;   ///< Along its heading.

  void visit_options(option_visitor& s) {
    s.field("t_s", t_s, {0, 1e6});
    s.field("position_m", position_m);
    s.field("heading_deg", heading_deg, {-360, 360});
    s.field("speed_mps", speed_mps, {-50, 100});
  }
};

/// A body that stands on the road, as a parked car does, or moves as is
/// written here, whatever others do.
struct obstacle_options {
  point position_m;       ///< Of its middle.
  double heading_deg = 0; ///< Along its length, counter-clockwise from east.
  double length_m = 4.5;
  double width_m = 1.8;
  /// Of one that moves, `moment` in the file: it is there from the first to
  /// the last, and what stands above does not count.
  std::vector<obstacle_moment> moments{};

  oriented_box box() const;

  bool moves() const { return !moments.empty(); }

  /// @returns one that moves.
  world::scripted_body script(station_id id) const;

  void visit_options(option_visitor& s) {
    if (s.has("position_m", !moves()))
      s.field("position_m", position_m);
    if (s.has("heading_deg", !moves()))
      s.field("heading_deg", heading_deg, {-360, 360});
    s.field("length_m", length_m, {0.1, 50});
    s.field("width_m", width_m, {0.1, 50});
    if (!s.has("moment", moves()))
      return;
    visit_list(s, "moment", moments);
    const auto is_late = [](const auto& a, const auto& b) {
      return a.t_s >= b.t_s;
    };
    if (std::ranges::adjacent_find(moments, is_late) != moments.end())
      s.refuse("moment", "must be in rising order of t_s.");
  }
};

} // namespace sofof::scenario
