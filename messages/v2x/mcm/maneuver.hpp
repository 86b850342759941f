// A plan on the wire: waypoints of a suggested maneuver, points of a planned
// trajectory, and the way back to a plan that a car can follow.
#pragma once

#include "base/geometry.hpp"
#include "base/time.hpp"
#include "messages/v2x/geo_frame.hpp"
#include "world/roads/route.hpp"
#include "world/vehicle/trajectory.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace sofof::messages {

/// What an MCM relates a plan to. Positions are those of the rear axle's
/// centre, in cm to geographic east (x) and north (y) of the message's
/// reference position as it stands in the message, that is rounded; times are
/// in ms since its generation (generationDeltaTime).
struct maneuver_frame {
  const geo_frame& earth;
  point reference;      ///< The rounded reference position on the map, m.
  time_point generated; ///< A whole millisecond.
};

/// A frame for a message, and what the message says of it.
struct maneuver_place {
  geo_position reference;
  maneuver_frame frame;
};

/// @returns the frame about the place nearest to `at` that a message can
/// name, and the last whole millisecond at or before `t`.
maneuver_place place_maneuver(const geo_frame& earth, point at, time_point t);

/// A LongitudinalWaypoint of a SuggestedManeuver (MCM after Mertens et al.
/// 2021) with one moment (minArrivalTime = maxArrivalTime) and one speed
/// (minVelocity = maxVelocity).
struct maneuver_waypoint {
  std::int32_t x_cm = 0, y_cm = 0; ///< ±131071.
  std::int32_t t_ms = 0;           ///< 0..65535.
  std::int32_t speed_cmps = 0;     ///< 0..16382.

  friend bool operator==(const maneuver_waypoint&,
                         const maneuver_waypoint&) = default;
};

/// A point of a PlannedTrajectory.
struct planned_point {
  std::int32_t x_cm = 0, y_cm = 0; ///< ±131071.
  std::int32_t speed_cmps = 0;     ///< 0..16382.
  std::int32_t heading = 0; ///< 0.1° clockwise from geographic north, 0..3599.

  friend bool operator==(const planned_point&, const planned_point&) = default;
};

/// A PlannedTrajectory: a point every `step_ms`.
struct planned_points {
  std::int32_t start_ms = 0; ///< 0..65535.
  std::int32_t step_ms = 0;  ///< 1..255.
  std::vector<planned_point> points;
};

/// An MCM carries no more of either.
inline constexpr std::size_t most_waypoints = 128;

/// Writes a plan down for a SuggestedManeuver. The first waypoint stands at
/// the plan's first whole millisecond, the last at its end (rounded to a
/// whole millisecond from the first); so times carry no error. Waypoints are
/// some 0.2 s apart, closer where the jerk jumps, and where the car comes to
/// rest. Each stands where, within some hundredths of a second, the plan comes
/// closest to whole centimetres beside its way and whole centimetres a second:
/// most of what rounding would cost is saved.
/// @param plan  `start >= frame.generated`.
/// @param out   Its capacity is reused.
/// @returns false when there is no such message (a plan that is not sound,
/// lasts more than 65 s or leads farther than 1.3 km away); `out` is empty.
bool to_waypoints(const world::trajectory& plan, const maneuver_frame& frame,
                  std::vector<maneuver_waypoint>& out);

/// The same for a PlannedTrajectory: from the plan's first whole millisecond
/// on a point every 0.2 s, or 0.1 s where the jerk jumps; it ends less than a
/// step early.
bool to_planned_points(const world::trajectory& plan,
                       const maneuver_frame& frame, planned_points& out);

/// Why what a stranger sent is no plan.
enum class maneuver_fault : std::uint8_t {
  none,
  wrong_count,      ///< Fewer than 2 points, or more than 128.
  times_not_rising, ///< Or steps of no time.
  out_of_range,     ///< Not what the ASN.1 allows.
  off_route,        ///< Farther than 5 m from the route.
  not_understood,   ///< It leaves open when to be where, or asks for more.
  no_motion,        ///< Nothing that a car could do.
};

/// @returns a few words that end a sentence: "the maneuver was refused: ".
std::string_view to_string(maneuver_fault fault);

/// Makes a plan of waypoints again: they are projected onto the route, then a
/// smooth line beside it is laid through them
/// (messages/v2x/mcm/lateral_fit.hpp), then a smooth motion along that line
/// (messages/v2x/mcm/longitudinal_fit.hpp). Safe with any numbers. No heap
/// after the first time.
/// @param way        The car's route.
/// @param s_guess_m  Arc length of the first point to within 20 m; laps count.
/// @param before     The plan in use. Where it agrees with the beginning to
///                   within rounding, the new plan continues it: what was
///                   learned of heading, curvature and acceleration stays.
///                   Null if none; not `&out`.
/// @param out        Starts at the first waypoint; a point every 0.1 s, or as
///                   near to it as ends with the last waypoint (every 1/160
///                   of more than 16 s). Sound, if there is no fault.
maneuver_fault to_trajectory(std::span<const maneuver_waypoint> waypoints,
                             const maneuver_frame& frame,
                             const world::route& way, double s_guess_m,
                             const world::trajectory* before,
                             world::trajectory& out);
maneuver_fault to_trajectory(const planned_points& planned,
                             const maneuver_frame& frame,
                             const world::route& way, double s_guess_m,
                             const world::trajectory* before,
                             world::trajectory& out);

} // namespace sofof::messages
