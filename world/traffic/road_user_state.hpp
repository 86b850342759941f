// A road user with its place on its route and its turn at the crossings.
#pragma once

#include "base/time.hpp"
#include "world/roads/unrolled_route.hpp"
#include "world/traffic/traffic.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace sofof::world {

/// What the traffic keeps of a road user.
struct road_user_state {
  /// How the last request to cross was answered.
  enum class answer {
    none, ///< There was none.
    go,
    full, ///< No room behind the crossing.
    held, ///< Somebody else is on it.
    wait, ///< Somebody else goes first.
  };

  road_user_state(const road_user& user,
                  std::shared_ptr<const unrolled_route> on)
      : known{user}, way{std::move(on)}, granted_to_m{front_m()} {
    seen.stop_at_m = front_m();
  }

  station_id station() const { return known.station; }

  road_user known;
  std::shared_ptr<const unrolled_route> way;
  unrolled_route::leg leg = 0; ///< Of the rear axle, as of the last update.

  /// It has, or had, the right to all zones that begin before.
  double granted_to_m;
  /// Where the first zone without that right begins, if near.
  double line_m = std::numeric_limits<double>::infinity();
  int rank = 0;                           ///< Right of way at that zone.
  std::optional<time_point> asks_since;   ///< To cross it.
  std::optional<time_point> stands_since; ///< Since the last grant, too.
  answer last = answer::none;

  perception seen;

  // Bumpers, as arc length on the route.
  double front_m() const { return known.s_m + known.front_m; }
  double rear_m() const { return known.s_m - known.rear_m; }
  double length_m() const { return known.front_m + known.rear_m; }
};

/// A zone keeps this far from the bumpers of who waits for it, m.
inline constexpr double stop_margin_m = 0.5;

/// Nobody looks farther ahead than this, m.
inline constexpr double sight_m = 200;

} // namespace sofof::world
