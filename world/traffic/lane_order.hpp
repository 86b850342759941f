// Who drives ahead of whom: the road users of every lane in order.
#pragma once

#include "world/traffic/road_user_state.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sofof::world {

/// A road user ahead, as seen from another one's route.
struct road_user_ahead {
  std::uint32_t who = 0; ///< Index of the driver seen.
  double axle_m = 0;     ///< Its rear axle, arc length on the other's route.
  double rear_m = 0;     ///< Its rear bumper, likewise.
  unrolled_route::leg own_leg = 0, its_leg = 0; ///< Where the two meet.
};

/// The road users of every lane. A body is on all lanes that it reaches into.
/// Of two side by side the lower station id is ahead, so that nobody is both
/// ahead and behind.
class lane_order {
public:
  /// @param all  Must outlive this.
  explicit lane_order(const conflict_sides& all);

  /// Sorts everybody into the lanes.
  /// @param drivers  Must stay where they are while this is asked about them.
  void sort(std::span<const road_user_state> drivers);

  /// @returns the nearest road user ahead of driver number `i`, within
  /// `sight_m`: on its way, or on a lane that begins or ends together with
  /// one of its own, as long as the bodies could touch there.
  std::optional<road_user_ahead> ahead_of(std::size_t i) const;

  /// @returns the next one ahead of `i` after `seen`.
  std::optional<road_user_ahead> beyond(std::size_t i,
                                        const road_user_ahead& seen) const;

  /// @returns up to where on the route of `i` the one seen stays in the way
  /// when it drives on, m; at most `limit_m`.
  double shared_to_m(std::size_t i, const road_user_ahead& seen,
                     double limit_m) const;

private:
  struct occupant {
    double s_m;      // rear axle, from the lane's start
    double to_end_m; // rear axle, to the lane's end
    double rear_m;   // rear axle to rear bumper
    station_id station;
    std::uint32_t who;
    unrolled_route::leg leg;
  };
  struct gaze; // a search along a driver's way

  std::optional<road_user_ahead> find(gaze from) const;
  void look_along(gaze& from, unrolled_route::leg i) const;
  void look_at_forking(gaze& from, unrolled_route::leg i,
                       const conflict_side& e) const;
  void look_at_joining(gaze& from, unrolled_route::leg i,
                       const conflict_side& e) const;

  const conflict_sides& all_;
  std::span<const road_user_state> drivers_;
  std::vector<std::vector<occupant>> lanes_;
};

} // namespace sofof::world
