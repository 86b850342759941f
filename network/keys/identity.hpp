// Who a peer is: the stations that it speaks for, or a provider.
#pragma once

#include "base/ids.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::network {

/// What URIs of stations begin with.
inline constexpr std::string_view station_prefix = "urn:sofof:station:";

/// Either some stations or the name of a provider.
struct peer_identity {
  std::vector<station_id> stations; ///< Each once, in order.
  std::string provider;

  bool operator==(const peer_identity&) const = default;

  bool is_provider() const { return !provider.empty(); }
  /// @returns whether it speaks for this station.
  bool has(station_id station) const;
};

/// @returns whether a provider may have this name: a letter or digit, then at
/// most 62 more of these, '.', '-' and '_'.
bool is_provider_name(std::string_view name);

/// @returns the identity that these URIs give: "urn:sofof:station:101",
/// "urn:sofof:station:101-106" (any number of them) or
/// "urn:sofof:provider:mec" (one). URIs of others do not count. nullopt when
/// there is none, when one of ours is broken, when there are both kinds, and
/// for more than `most_stations`.
std::optional<peer_identity> identity_of(std::span<const std::string> uris);

/// @returns the fewest URIs that give this identity.
std::vector<std::string> uris_of(const peer_identity& who);

/// @returns e.g. "stations 101-106,110", "station 7" or "provider mec".
std::string describe(const peer_identity& who);

} // namespace sofof::network
