// What vehicles and whoever plans for them say to each other: MCMs.
#pragma once

#include "messages/etsi/mcm.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/georeference.hpp"
#include "messages/v2x/mcm/maneuver.hpp"
#include "world/roads/route.hpp"
#include "world/vehicle/vehicle.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sofof::messages {

/// A suggested maneuver: one offloading of a vehicle's planning. Of both
/// numbers the last 16 bits travel.
struct maneuver_name {
  std::uint16_t maneuver = 0; ///< Counter of the session.
  std::uint16_t update = 0;   ///< Cycle of the plan.
};

// -- up: from the vehicle -----------------------------------------------------

/// What a vehicle tells who plans for it.
struct mcm_uplink {
  cam own; ///< Its motion now.
  /// Where it is allowed to go: its planned route, up to where its front must
  /// not pass yet, m, east-north. At least one.
  std::span<const point> way;
  /// The plan in use, for who takes over from another planner; null: none.
  const world::trajectory* plan = nullptr;
  /// What it answers to a suggestion.
  std::optional<std::pair<maneuver_name, etsi::maneuver_response>> answer;
};

etsi::mcm make_word(const mcm_uplink& word, const world::vehicle_params& car,
                    const georeference& where);

/// What a provider understands of it.
struct decoded_mcm {
  station_id from = 0;
  time_point at;
  std::vector<point> way; ///< As in `mcm_uplink`; may be empty.
  std::optional<planned_points> plan;
  std::optional<std::pair<maneuver_name, etsi::maneuver_response>> answer;
  point reference; ///< What the plan's points are seen from.
  /// Of its body; nullopt: larger than an MCM can tell (6.1 m), or not told.
  std::optional<double> length_m, width_m;
};

/// @param now  The message tells its time modulo 65.536 s: the nearest to now
///             is meant.
/// @returns nullopt for what is no word of a road user.
std::optional<decoded_mcm> read_word(const etsi::mcm& message,
                                     const georeference& where, time_point now);

// -- down: from the provider --------------------------------------------------

/// Who suggests, and to whom.
struct suggestion {
  station_id from = 0;
  point position; ///< Of the provider, m, east-north.
  station_id to = 0;
  maneuver_name name;
};

/// The plan as waypoints of a SuggestedManeuver, each with one arrival time and
/// one speed. The reference position is the provider's; if that is too far
/// away for waypoints, the plan's first point.
/// @param plan  Sound.
/// @param room  Used again and again.
/// @param out   Its room is used again, too.
/// @returns false if the plan cannot be written down.
bool make_suggestion(const suggestion& what, const world::trajectory& plan,
                     const georeference& where,
                     std::vector<maneuver_waypoint>& room, etsi::mcm& out);

/// There is nothing to suggest now.
etsi::mcm make_silence(const suggestion& what, time_point at,
                       const georeference& where);

etsi::mcm make_termination(const suggestion& what, time_point at,
                           etsi::termination_status why,
                           const georeference& where);

/// A suggested plan, along the vehicle's route.
/// @param me         What is suggested to others is nothing to this station.
/// @param s_guess_m  About where it begins.
/// @param before     The plan in use until now; null: none.
/// @param out        Sound if there is no fault; its points are reused.
/// @returns why it is no plan; nullopt if the message suggests none.
std::optional<maneuver_fault>
read_suggestion(const etsi::mcm& message, station_id me,
                const world::route& way, double s_guess_m,
                const georeference& where, time_point now,
                const world::trajectory* before, world::trajectory& out);

/// @returns a number of the suggested places and speeds, whatever their times:
/// a plan that is sent again has the same. 0 if the message suggests none.
std::uint64_t fingerprint_of_plan(const etsi::mcm& message);

} // namespace sofof::messages
