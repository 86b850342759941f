// Identities as URIs, and as words.
#include "network/keys/identity.hpp"

#include "network/keys/station_list.hpp"

#include <algorithm>

namespace sofof::network {

namespace {

constexpr std::string_view ours = "urn:sofof:";
constexpr std::string_view provider_prefix = "urn:sofof:provider:";
constexpr std::size_t longest_name = 63;

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')
         || (c >= '0' && c <= '9');
}

} // namespace

bool peer_identity::has(station_id station) const {
  return std::ranges::binary_search(stations, station);
}

bool is_provider_name(std::string_view name) {
  return !name.empty() && name.size() <= longest_name
         && is_letter_or_digit(name.front())
         && std::ranges::all_of(name, [](char c) {
              return is_letter_or_digit(c) || c == '.' || c == '-' || c == '_';
            });
}

std::optional<peer_identity> identity_of(std::span<const std::string> uris) {
  std::string list;
  std::string provider;
  for (std::string_view uri : uris) {
    if (!uri.starts_with(ours))
      continue;
    if (uri.starts_with(station_prefix)) {
      uri.remove_prefix(station_prefix.size());
      if (!list.empty())
        list += ',';
      list += uri;
    } else if (uri.starts_with(provider_prefix) && provider.empty()) {
      uri.remove_prefix(provider_prefix.size());
      if (!is_provider_name(uri))
        return std::nullopt;
      provider = uri;
    } else {
      return std::nullopt;
    }
  }
  if (list.empty() == provider.empty())
    return std::nullopt;
  if (!provider.empty())
    return peer_identity{{}, provider};
  auto stations = parse_stations(list);
  if (!stations)
    return std::nullopt;
  return peer_identity{std::move(*stations), {}};
}

std::vector<std::string> uris_of(const peer_identity& who) {
  std::vector<std::string> uris;
  for (const auto& range : station_ranges(who.stations))
    uris.push_back(std::string{station_prefix} + print_station_range(range));
  if (who.is_provider())
    uris.push_back(std::string{provider_prefix} + who.provider);
  return uris;
}

std::string describe(const peer_identity& who) {
  if (who.is_provider())
    return "provider " + who.provider;
  return (who.stations.size() == 1 ? "station " : "stations ")
         + print_stations(who.stations);
}

} // namespace sofof::network
