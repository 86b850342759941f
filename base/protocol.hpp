// The constants of the offloading protocol, in one place.
#pragma once

#include "base/time.hpp"

#include <cstddef>

namespace sofof::protocol {

using namespace std::chrono_literals;

/// Between two offers to a station that has an offered service not running.
inline constexpr duration offer_period = 1s;
/// An offer may be taken up for so long; one that is lost costs no choice.
inline constexpr duration offer_validity = offer_period * 5 / 2;
/// From a request to its response; then the services stay local.
inline constexpr duration request_timeout = 500ms;
/// From acceptance to the first data; the local service runs on meanwhile.
inline constexpr duration start_timeout = 1s;
/// From the end of a session by a fault to the next request of that service to
/// that provider.
inline constexpr duration cool_down = 1s;
/// A station has gone of which neither a CAM nor another broadcast message has
/// come for longer.
/// Source: Dehler & Buchholz 2025, CAM check.
inline constexpr duration cam_timeout = 2s;
/// Between two looks of a vehicle at whether a CAM or a CPM is due
/// (T_CheckCamGen), and between two messages of its motion to its requester.
inline constexpr duration ego_period = 100ms;
/// Between two answers to results of unknown sessions.
inline constexpr duration unknown_result_period = 200ms;
/// Between two digests of what runs for a station; they go on for so long when
/// nothing does any more.
inline constexpr duration digest_period = 500ms;
inline constexpr duration digest_goes_on = digest_period * 4;
/// A session is over of which neither a result nor a digest has come for
/// longer: four of these were lost, or there are none.
inline constexpr duration confirmation_timeout = digest_period * 9 / 2;

/// Between two pings on a connection between hosts.
inline constexpr duration ping_period = 50ms;
/// Who has been silent for longer is cut off.
inline constexpr duration silence_limit = 1s;
/// For every step of a handshake.
inline constexpr duration handshake_timeout = 2s;

/// Clocks of vehicles, sensors and providers agree within this.
inline constexpr duration clock_tolerance = 200ms;

/// @returns whether something cannot have been seen or said yet. Believing one
/// such thing would make all true ones too old.
constexpr bool is_of_future(time_point at, time_point now) {
  return at > now + clock_tolerance;
}

/// A request names so many providers at most that could be asked, the nearest.
inline constexpr std::size_t most_candidates = 64;

/// Planned path that a requester looks at and sends along, m, and its step.
inline constexpr double route_ahead_m = 800;
inline constexpr double route_spacing_m = 5;

/// How far ahead a vehicle tells who plans for it that it may go, m, and in
/// which steps. Who is told less has to stop there.
inline constexpr double authority_m = 200;
inline constexpr double authority_spacing_m = 20;

/// Between two steps of a vehicle and its controller.
inline constexpr duration control_period = 10ms;
/// Between two looks at the others.
inline constexpr duration sensor_period = 50ms;

} // namespace sofof::protocol
