// Names of things: who talks, and what it is about.
#pragma once

#include "base/strong_id.hpp"

#include <cstdint>
#include <optional>

namespace sofof {

/// A connected vehicle, as in ETSI ITS (StationID).
using station_id = strong_id<struct station_tag, std::uint32_t>;

/// Whose certificate a message came by: all stations of one certificate have
/// one sender.
using sender_id = strong_id<struct sender_tag, std::uint64_t>;

/// @returns the number of the k-th obstacle, counting from 0. They count down
/// from the highest there is.
constexpr station_id obstacle_id(std::uint32_t k) {
  return ~station_id::rep{0} - k;
}

/// @returns whether this is the number of one of `count` obstacles.
constexpr bool is_obstacle(station_id x, std::uint32_t count) {
  return x > obstacle_id(count);
}

/// @returns the station id of the k-th provider, counting from 0.
constexpr station_id provider_station(std::uint32_t k) {
  return 900'000'001 + k;
}

/// These numbers are kept for providers.
inline constexpr std::uint32_t provider_stations = 1'000'000;

/// @returns whether this is the station id of a provider.
constexpr bool is_provider_station(station_id x) {
  return x >= provider_station(0) && x < provider_station(provider_stations);
}

/// A provider process since its start; a restarted one has a new id.
using provider_id = strong_id<struct provider_tag, std::uint64_t>;

/// Where a service runs: at a provider, or in the vehicle itself (nullopt).
using service_place = std::optional<provider_id>;

/// @param place  Of the provider in the scenario's file, counting from 1,
///               < 65536.
/// @param start  When its process started, in any unit; 0 if it is the only
///               one.
constexpr provider_id provider_at(std::uint32_t place, std::uint64_t start) {
  return start << 16 | place;
}

/// @returns the place of a provider in the scenario's file.
constexpr provider_id place_of(provider_id provider) {
  return provider.value() & 0xffff;
}

} // namespace sofof
