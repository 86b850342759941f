// Asks a web server.
#pragma once

#include "network/http/message.hpp"
#include "network/network_address.hpp"

#include <chrono>
#include <cstdint>
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

/// What is asked, beyond a URL.
struct question {
  std::string method = "GET";
  std::string type; ///< Of the body.
  std::string body;
};

/// What an answer may take.
struct bounds {
  std::chrono::milliseconds patience; ///< All together, names of hosts, too.
  std::uint64_t most_octets = 1U << 20;
};

/// Asks, and follows no redirection.
/// @returns the answer. @throws network_error.
response ask(const question& how, const url& what, const bounds& within);

/// Asks by GET. @returns the answer, of at most 1 MiB. @throws network_error.
response get(const url& what, std::chrono::milliseconds patience);

} // namespace sofof::network::http
