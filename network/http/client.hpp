// Asks a web server.
#pragma once

#include "network/http/message.hpp"
#include "network/network_address.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::network::http {

/// Where something is asked for by HTTP, without TLS.
struct url {
  network_address at;
  std::string target = "/"; ///< Path and query.
};

/// Reads "http://HOST[:PORT][/PATH]"; the port is 80 if none stands there.
/// @returns nullopt for anything else.
std::optional<url> parse_url(std::string_view text);

/// Asks by GET.
/// @param patience  How long all together may take, but for the resolver, which
///                  may take longer for a name that it does not find.
/// @returns the answer, of at most 1 MiB. @throws network_error.
response get(const url& what, std::chrono::milliseconds patience);

} // namespace sofof::network::http
