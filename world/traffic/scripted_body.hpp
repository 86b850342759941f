// A body that moves as was written down before, whatever others do.
#pragma once

#include "world/roads/road_body.hpp"

#include <optional>
#include <vector>

namespace sofof::world {

/// A road user of a recording, say: it gives way to nobody.
class scripted_body {
public:
  /// Where the middle of its body is, and how fast it moves along its heading.
  struct moment {
    double t_s = 0;
    point at;
    double heading_rad = 0;
    double speed_mps = 0; ///< Negative: backwards.
  };

  /// @param id       No other body's.
  /// @param moments  At least one, in rising order of time.
  scripted_body(station_id id, double length_m, double width_m,
                std::vector<moment> moments);

  /// @returns it as it is then, between two moments at even shares of both;
  /// nullopt before the first and after the last: it is not there.
  std::optional<road_body> at(double t_s) const;

private:
  station_id id_;
  double length_m_, width_m_;
  std::vector<moment> moments_;
};

} // namespace sofof::world
