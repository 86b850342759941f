// What a sensor sees of the bodies on the road: those in its range that
// nothing hides, not quite where they are.
#pragma once

#include "base/cell_grid.hpp"
#include "base/options/option_visitor.hpp"
#include "base/random.hpp"
#include "base/time.hpp"
#include "world/roads/road_body.hpp"
#include "world/roads/road_map.hpp"
#include "world/sensing/perception.hpp"
#include "world/sensing/viewpoint.hpp"

#include <array>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace sofof::world {

/// What a sensor can do. Its errors are normal and independent: of each other,
/// of what it saw before, and of what others see.
struct sensor_params {
  double range_m = 100;            ///< To the middle of a body.
  double field_of_view_deg = 360;  ///< Round its heading.
  double position_noise_m = 0.1;   ///< Standard deviation, east and north each.
  double speed_noise_mps = 0.1;    ///< Standard deviation.
  double heading_noise_rad = 0.01; ///< Standard deviation.
  bool occlusion = true; ///< Do bodies and buildings hide what is behind them?

  void visit_options(option_visitor& s) {
    s.field("range_m", range_m, {0, 1000});
    s.field("field_of_view_deg", field_of_view_deg, {0, 360});
    s.field("position_noise_m", position_noise_m, {0, 100});
    s.field("speed_noise_mps", speed_noise_mps, {0, 100});
    s.field("heading_noise_rad", heading_noise_rad, {0, std::numbers::pi});
    s.field("occlusion", occlusion);
  }
};

/// A sensor, where it is now.
struct sensor {
  sensor_params can;
  random_stream noise{0, ""};        ///< A stream of its own.
  point at;                          ///< m, east-north.
  double heading_rad = 0;            ///< Of the middle of its field of view.
  std::optional<station_id> carrier; ///< The body that it is mounted on.

  viewpoint view() const {
    return {at, heading_rad, can.range_m, can.field_of_view_deg};
  }
};

/// All that can be seen and all that can hide it, at one moment.
class scene {
public:
  /// @throws std::invalid_argument for a building that is no simple polygon.
  explicit scene(std::span<const building> buildings = {});

  /// Replaces all bodies; costs as much as there are, whatever the map.
  void place(std::span<const road_body> bodies);

  /// A body is seen when its middle is within range, and when its middle or one
  /// of its corners is within the field of view and the straight line from the
  /// sensor to there meets no building and no third body. What the sensor
  /// itself stands in, or under, hides nothing.
  /// @param now  Noise is drawn anew for every moment; it does not depend on
  ///             who else is there.
  /// @returns what is seen, without the sensor's carrier, in order of the true
  ///          distance (equally far: of the ids). Sizes and accelerations are
  ///          the true ones.
  std::vector<perceived_object> seen_by(const sensor& s, time_point now) const;

private:
  /// What can hide others.
  struct solid {
    point middle;
    double radius_m = 0; ///< No corner is farther from the middle.
  };
  struct house : solid {
    polygon shape;
  };
  struct vehicle : solid {
    road_body is;
    std::array<point, 4> corners;
  };
  struct outlook;

  outlook look_round(const sensor& s) const;

  std::vector<house> houses_;
  std::vector<vehicle> bodies_;
  cell_grid house_cells_, body_cells_;              // of the middles
  double largest_house_m_ = 0, largest_body_m_ = 0; // radii
};

} // namespace sofof::world
