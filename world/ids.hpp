// Names of things: who talks, and what it is about.
#pragma once

#include <cstdint>

namespace sofof {

/// A connected vehicle, as in ETSI ITS (StationID).
using station_id = std::uint32_t;

/// @returns the number of the k-th obstacle, counting from 0. They count down
/// from the highest there is.
constexpr station_id obstacle_id(std::uint32_t k) {
  return ~station_id{0} - k;
}

/// @returns whether this is the number of one of `count` obstacles.
constexpr bool is_obstacle(station_id x, std::uint32_t count) {
  return x > obstacle_id(count);
}

/// @returns the station id of the k-th provider, counting from 0.
constexpr station_id provider_station(std::uint32_t k) {
  return 900'000'001 + k;
}

/// A provider process since its start; a restarted one has a new id.
using boot_id = std::uint64_t;

} // namespace sofof
