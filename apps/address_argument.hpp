// HOST:PORT on the command line.
#pragma once

#include "base/input_error.hpp"
#include "network/network_address.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace sofof::apps {

/// @throws input_error.
inline network::network_address address_of(std::string_view text) {
  auto address = network::parse_address(text);
  if (!address)
    throw input_error(fmt::format(
        "'{}' is no HOST:PORT, like 10.0.0.5:4711 or [::1]:4711", text));
  return *address;
}

/// @returns what is wrong with an address, as CLI11 asks for it; else nothing.
inline std::string trouble_with_address(const std::string& text) {
  if (network::parse_address(text))
    return "";
  return fmt::format("'{}' is no HOST:PORT, like 127.0.0.1:9464", text);
}

} // namespace sofof::apps
