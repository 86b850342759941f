// What ties a run to the Earth and to the time of day.
#pragma once

#include "messages/etsi/common.hpp"
#include "messages/etsi/its_time.hpp"
#include "messages/v2x/geo_frame.hpp"

#include <memory>

namespace sofof::messages {

/// Where the map is, and when the run's clock stood at zero.
struct georeference {
  geo_frame frame;
  etsi::its_clock clock;

  /// @returns the same as a sender has it whose time of day is ahead of ours.
  georeference ahead_by(duration d) const { return {frame, clock.ahead_by(d)}; }

  /// @returns the moment that a message tells in its 16 bits: the nearest to
  /// `now` there is.
  time_point unwrapped(etsi::wrapped_ms ms, time_point now) const {
    return clock.time(etsi::unwrap(ms, clock.timestamp(now)));
  }
};

using georeference_ptr = std::shared_ptr<const georeference>;

/// @returns a position without height and without an idea of its error: SOFOF
/// knows neither.
inline etsi::reference_position to_reference(const geo_position& at) {
  etsi::reference_position position;
  position.latitude = at.latitude;
  position.longitude = at.longitude;
  return position;
}

inline geo_position to_geo(const etsi::reference_position& position) {
  return {position.latitude, position.longitude};
}

} // namespace sofof::messages
