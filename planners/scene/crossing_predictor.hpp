// Who crosses the own way, when, and who goes first: judged by what is seen.
#pragma once

#include "planners/scene/driving_scene.hpp"
#include "planners/scene/lane_network.hpp"
#include "planners/scene/track.hpp"
#include "world/roads/unrolled_route.hpp"

#include <cstddef>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

namespace sofof::planners {

/// Another road user, at the present.
struct other_body {
  track x;
  bool is_crossing = false; ///< On or before a zone of the own way, moving.
};

/// @param cosine  Of the angle between a body and a way.
/// @returns whether the body drives along it: to within 45°.
inline bool is_along(double cosine) {
  return cosine > std::numbers::sqrt2 / 2;
}

/// Judges the crossings of one route.
class crossing_predictor {
public:
  /// @param lanes       Of the map that the route is on; not null.
  /// @param corridor_m  Whoever is within this of the centre line and drives
  ///                    along is not crossing.
  /// @param foresight_s Others get so far at their present speed.
  crossing_predictor(std::shared_ptr<const lane_network> lanes,
                     world::route_ptr way, double corridor_m,
                     double foresight_s);

  /// Finds the zones of the own way that end after `from_m` and begin before
  /// `to_m`, and for each of them everybody on its other side or on the way
  /// there. Marks those who cross.
  /// @param found   In the order of zones.
  /// @param yields  Where zones begin whose other side goes first by rank.
  void judge(double from_m, double to_m, std::span<other_body> others,
             std::vector<crossing_user>& found, std::vector<double>& yields);

private:
  struct own_zone {
    world::zone on;
    point middle;
  };
  struct foreseen {
    std::size_t who;
    conflict_visit when;
  };
  void find_zones(double from_m, double to_m);
  void foresee(std::span<const other_body> others);
  bool drives_along(const track& x, const world::zone& z) const;

  std::shared_ptr<const lane_network> lanes_;
  world::unrolled_route way_;
  double corridor_m_, foresight_s_;
  std::vector<own_zone> zones_;
  std::vector<conflict_visit> arrivals_; // of one of the others
  std::vector<foreseen> foreseen_;
};

} // namespace sofof::planners
