// What is seen from a route: how far it is free, and whether who goes first at
// its crossings is seen in time.
#pragma once

#include "planners/scene/lane_network.hpp"
#include "planners/scene/line_of_sight.hpp"
#include "world/roads/unrolled_route.hpp"
#include "world/sensing/viewpoint.hpp"
#include "world/vehicle/vehicle.hpp"

#include <span>
#include <vector>

namespace sofof::planners {

/// By whom is seen what a plan depends on.
struct eyes_on_road {
  double range_m = 100; ///< Of a car's own sensor, in the middle of its body.
  double field_of_view_deg = 360; ///< Round its heading.
  bool houses_hide = true;        ///< What is behind them.
  /// Of sensors at the roadside, which tell what they see.
  std::vector<world::viewpoint> roadside;
};

/// A place where others go first, arc lengths of the rear axle.
struct blind_corner {
  double line_m = 0;      ///< The front is at the crossing.
  double seen_from_m = 0; ///< From here to the line those are seen who come;
                          ///< the line itself where they never are.
};

/// The view along one route, by the houses of its map. Bodies that stand or
/// drive hide others too, but move or lead.
class route_sight {
public:
  /// @param houses  Of the map; kept.
  route_sight(world::route_ptr way, const line_of_sight& houses,
              const eyes_on_road& eyes, const world::vehicle_params& car = {});

  /// @param s_m  Of the rear axle.
  /// @returns how far the centre line before the front bumper is in sight, m;
  /// up to where a car's middle would be seen.
  double ahead_m(double s_m) const;

  /// @param lanes  Of the route's map.
  /// @returns all corners at which somebody who comes first by rank, or from
  /// the right at equal ranks, is not seen from everywhere, or the end of the
  /// crossings, where somebody may stand, is not; in order.
  std::vector<blind_corner> corners(const lane_network& lanes) const;

private:
  world::viewpoint eye_at(double s_m) const;
  bool is_seen(point p, const world::viewpoint& eye) const;
  bool is_seen_from(const world::viewpoint& eye, point p) const;
  bool is_told(point p) const;
  void add_long_ones(const world::unrolled_route& zones,
                     std::vector<blind_corner>& found) const;
  blind_corner look_at(double line_m, std::span<const point> those) const;

  world::route_ptr way_;
  const line_of_sight& houses_;
  eyes_on_road eyes_;
  world::vehicle_params car_;
};

} // namespace sofof::planners
