// Lists of stations: numbers, '-' and ','.
#include "network/keys/station_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace sofof::network {

namespace {

std::optional<station_id> parse_station(std::string_view text) {
  station_id::rep station = 0;
  const auto* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, station);
  if (error != std::errc{} || rest != end || station == 0)
    return std::nullopt;
  return station;
}

} // namespace

std::optional<station_range> parse_station_range(std::string_view text) {
  const auto dash = text.find('-');
  const auto first = parse_station(text.substr(0, dash));
  const auto last =
      dash == text.npos ? first : parse_station(text.substr(dash + 1));
  if (!first || !last || *last < *first)
    return std::nullopt;
  return station_range{*first, *last};
}

std::string print_station_range(station_range range) {
  const auto [first, last] = range;
  auto text = fmt::to_string(first);
  if (last != first)
    text += "-" + fmt::to_string(last);
  return text;
}

std::optional<std::vector<station_id>> parse_stations(std::string_view text) {
  std::vector<station_id> stations;
  for (std::size_t at = 0; at <= text.size();) {
    const auto comma = std::min(text.find(',', at), text.size());
    const auto range = parse_station_range(text.substr(at, comma - at));
    if (!range)
      return std::nullopt;
    const auto first = range->first.value(), last = range->second.value();
    if (last - first >= most_stations)
      return std::nullopt;
    for (auto k = last - first + 1; k > 0; --k)
      stations.push_back(first + (k - 1));
    if (stations.size() > most_stations)
      return std::nullopt;
    at = comma + 1;
  }
  std::ranges::sort(stations);
  const auto [twice, end] = std::ranges::unique(stations);
  stations.erase(twice, end);
  return stations;
}

std::vector<station_range>
station_ranges(const std::vector<station_id>& stations) {
  std::vector<station_range> ranges;
  for (const auto station : stations) {
    if (!ranges.empty() && ranges.back().second.value() + 1 == station)
      ranges.back().second = station;
    else
      ranges.emplace_back(station, station);
  }
  return ranges;
}

std::string print_stations(const std::vector<station_id>& stations) {
  std::string text;
  for (const auto& range : station_ranges(stations))
    text += (text.empty() ? "" : ",") + print_station_range(range);
  return text;
}

} // namespace sofof::network
