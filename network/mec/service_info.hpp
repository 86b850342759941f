// What a registry of ETSI GS MEC 011 v2.2.1 says of a provider.
#pragma once

#include "network/network_address.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sofof::network::mec011 {

/// `serName` of every provider.
inline constexpr std::string_view service_name = "sofof";

// What a registry says is refused beyond these.
inline constexpr std::size_t longest_document = 256 * 1024;
inline constexpr std::size_t most_services = 256;
inline constexpr std::size_t most_addresses = 8; ///< Of one service.
inline constexpr std::size_t longest_name = 128;

/// A ServiceInfo (clause 8.1.2.2), as far as providers need it.
struct service_info {
  std::string id{};       ///< `serInstanceId`, which the registry chooses.
  std::string version{};  ///< Of the protocol that the provider speaks.
  bool is_active = true;  ///< Else it takes nobody.
  std::string provider{}; ///< Its name, as in scenarios and certificates.
  bool is_secured = true; ///< Whether it speaks TLS.
  std::vector<network_address> addresses{}; ///< Any of them leads to it.

  bool operator==(const service_info&) const = default;
};

/// @returns whether the text may stand in a path as it is, as names of
/// applications and services do: letters, digits and "-._~".
bool is_plain_name(std::string_view text);

/// @returns whether a text may be the name or the address of a host.
bool is_host(std::string_view text);

/// @returns whether a host stands for wherever one listens: 0.0.0.0 or ::.
bool is_anywhere(std::string_view host);

/// @returns the ServiceInfo.
std::string to_json(const service_info& what);

/// Reads what a registry says of one service.
/// @returns it, or what is wrong with it.
std::variant<service_info, std::string> read_service(std::string_view json);

/// Services of a registry.
struct service_list {
  std::vector<service_info> services;
  std::string why_not_all; ///< Why one of ours is left out; empty: none is.
};

/// Reads what a registry says of all its services; those of other names are
/// left out.
/// @returns it, or what is wrong with all of it.
std::variant<service_list, std::string> read_services(std::string_view json);

/// @returns what a ProblemDetails (RFC 7807) says; empty: nothing.
std::string read_problem(std::string_view json);

} // namespace sofof::network::mec011
