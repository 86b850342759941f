// Who has nearly hit whom: a measure of safety where nobody collides.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"
#include "world/roads/road_body.hpp"
#include "world/traffic/traffic.hpp"

#include <chrono>
#include <optional>
#include <span>
#include <vector>

namespace sofof::world {

/// Time to collision: how long until two bodies touch if both go on straight
/// ahead as fast as now.
/// @returns seconds; 0 when they touch; nullopt when they would pass.
/// Source: Hayward 1972, with whole bodies as in Gettman et al. 2008.
std::optional<double> time_to_collision_s(const road_body& a,
                                          const road_body& b);

/// The same of road users that follow their lanes: each goes on along its route
/// as fast as now, and drifts across it as now, so that who takes a bend is not
/// taken to leave it. On straight lanes there is no difference.
/// @returns as above; nullopt also when they touch later than `near_miss_s`.
std::optional<double> time_to_collision_s(const road_user& a,
                                          const road_user& b);

/// A time to collision below this is a near miss.
/// Source: Gettman et al. 2008, Surrogate Safety Assessment Model and
/// Validation, FHWA-HRT-08-051 (its default threshold).
inline constexpr double near_miss_s = 1.5;

/// Two bodies that come so near again sooner than this have not parted.
inline constexpr duration same_encounter = std::chrono::seconds{2};

/// Two bodies have come so near.
struct near_miss {
  station_id first = 0, second = 0; ///< Lower id first.
  double time_to_collision_s = 0;   ///< When it fell below the limit.
};

/// Finds near misses, each encounter once.
class near_miss_watch {
public:
  /// @param users  All that count, as they are now. Not the same two twice.
  /// @param now    Not before that of the last call.
  /// @returns the encounters that have just begun, by their ids; valid until
  /// the next call.
  std::span<const near_miss> look(std::span<const road_user> users,
                                  time_point now);

private:
  struct encounter {
    station_id first, second;
    time_point last; // when they were so near
  };
  struct extent { // whom a body can reach in time
    double west_m, east_m;
    const road_user* who;
  };

  void meet(const road_user& a, const road_user& b, time_point now);

  std::vector<extent> from_west_;
  std::vector<encounter> open_;
  std::vector<near_miss> begun_;
};

} // namespace sofof::world
