// Lists of stations as people write them: "101-106,110".
#pragma once

#include "base/ids.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::network {

/// More stations than these are no list.
inline constexpr std::size_t most_stations = 10'000;

/// First and last station of a range; both belong to it.
using station_range = std::pair<station_id, station_id>;

/// Reads one station or one range: "110", "101-106".
/// @returns nullopt for anything else, for station 0, which is nobody, and when
/// the last comes before the first.
std::optional<station_range> parse_station_range(std::string_view text);

/// @returns the station, or first and last of the range with a '-' between.
std::string print_station_range(station_range range);

/// Reads stations and ranges with commas between them, in any order.
/// @returns each station once, in order; nullopt for anything else, for an
/// empty list, and for more than `most_stations`.
std::optional<std::vector<station_id>> parse_stations(std::string_view text);

/// @param stations  Each once, in order.
/// @returns the ranges that they make up.
std::vector<station_range>
station_ranges(const std::vector<station_id>& stations);

/// @param stations  Each once, in order.
/// @returns the shortest list that `parse_stations` reads as these.
std::string print_stations(const std::vector<station_id>& stations);

} // namespace sofof::network
