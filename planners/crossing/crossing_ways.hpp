// The ways of vehicles through crossings, and where bodies on them meet.
#pragma once

#include "planners/scene/lane_network.hpp"
#include "planners/speed/route_profile.hpp"
#include "world/roads/meeting_curve.hpp"
#include "world/roads/unrolled_route.hpp"
#include "world/vehicle/vehicle.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::planners {

/// A way through one crossing, in arc lengths of the body's middle on its
/// route.
struct crossing_way {
  route_profile_ptr way;
  double enters_m = 0;      ///< The front comes to the first place that others
                            ///< use.
  double leaves_m = 0;      ///< The rear has left the last one.
  std::size_t lane = 0;     ///< Of the map, on which it comes, ...
  double lane_ends_m = 0;   ///< ... until there.
  std::size_t out_lane = 0; ///< On which it goes on.
  bool is_round = false;    ///< It goes through a roundabout.
};

/// All ways that were asked for through the crossings of an area, and how
/// bodies on them meet: computed when first needed, then kept. A roundabout is
/// one crossing: who waited on it would hold up all others.
class crossing_ways {
public:
  struct area {
    point centre;
    double radius_m = 0;
  };

  /// Places that others use belong to one crossing if less lies between them,
  /// or a roundabout.
  static constexpr double one_crossing_m = 10;
  /// Ways are compared so far before and behind a crossing, m.
  static constexpr double before_m = 80, behind_m = 30;

  crossing_ways(std::shared_ptr<const lane_network> lanes, area within,
                const world::vehicle_params& car);

  /// Where a vehicle is on its way through a crossing.
  struct place {
    std::size_t way = 0; ///< Its number.
    double middle_m = 0; ///< As in `crossing_way`.
    double lap_m = 0;    ///< So much more it is on the route as counted there.
  };

  /// @param s_m  Of the rear axle on the route, laps included.
  /// @returns the crossing that a vehicle is on or comes to next; nullopt if
  /// there is none within `ahead_m`.
  std::optional<place> find(const route_profile_ptr& way, double s_m,
                            double ahead_m);

  const crossing_way& operator[](std::size_t way) const { return ways_[way]; }

  /// @returns how far a vehicle on the one way must have come before another
  /// one may be somewhere on the other.
  const world::meeting_curve& meet(std::size_t first, std::size_t then);

  /// @returns whether one follows the other: before the crossing, behind it, or
  /// on a roundabout.
  bool follow(std::size_t a, std::size_t b) const {
    return ways_[a].lane == ways_[b].lane
           || ways_[a].out_lane == ways_[b].out_lane
           || (ways_[a].is_round && ways_[b].is_round);
  }

  /// @returns way from a body's middle to its rear axle, m.
  double middle_m() const { return (car_.front_m - car_.rear_m) / 2; }

private:
  struct known_route {
    route_profile_ptr way;
    std::vector<std::size_t> ways; // of one lap, rising enters_m
  };
  const known_route& know(const route_profile_ptr& way);
  void list_ways(known_route& route);
  void find_lanes(const world::route& route, crossing_way& x) const;

  std::shared_ptr<const lane_network> lanes_;
  area within_;
  world::vehicle_params car_;
  std::map<std::string, known_route> routes_; // by name
  std::vector<crossing_way> ways_;
  std::map<std::pair<std::size_t, std::size_t>, world::meeting_curve> meet_;
};

} // namespace sofof::planners
