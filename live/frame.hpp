// What is sent to those who look on, ten times a second.
#pragma once

#include "scenario/operations.hpp"

#include "live/run_state.hpp"
#include <cstdint>
#include <span>
#include <string>

namespace sofof::live {

/// What all who look on get at one moment.
struct moment {
  std::string_view run; ///< Which run it is, by a number.
  std::uint64_t number; ///< Of the frame, from 1 on.
  time_point start;     ///< Of the run.
  time_point now;
  bool is_ending = false;
};

/// @param loads  Of providers that run here, by their names in `names`.
/// @param names  Of all providers, in the order of the file.
/// @returns the fields of a JSON object, but for its end: time, cars, loads,
/// counts. Times are in seconds since the start, places in metres; docs:
/// docs/operations/README.md.
std::string frame_text(const moment& of,
                       const std::map<station_id, seen_car>& cars,
                       std::span<const scenario::operations::load> loads,
                       std::span<const std::string> names,
                       const seen_counts& counts);

/// @returns such a frame with events, as a server-sent event; its id is
/// that of the last event.
/// @param last  If there are no events.
std::string event_text(const std::string& frame, time_point start,
                       std::span<const told_event> events, std::uint64_t last);

} // namespace sofof::live
