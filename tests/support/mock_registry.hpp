// A registry of services as the public OpenAPI files of ETSI GS MEC 011 v2.2.1
// describe it, on this machine, which also does what one should not.
#pragma once

#include "network/network_address.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sofof::test {

/// How a registry answers.
enum class registry_mood : std::uint8_t {
  well,
  silent,    ///< It does not.
  garbage,   ///< Status 200, and no JSON.
  huge,      ///< A list of 16 MiB.
  crowded,   ///< Ten thousand providers.
  redirects, ///< To a port of this machine.
  broken,    ///< Status 500, and a reason.
  immutable, ///< Well, but PUT is not allowed.
};

class mock_registry {
public:
  /// Knows one application, "sofof-mec". @param port  0: any.
  explicit mock_registry(std::uint16_t port = 0);
  ~mock_registry();
  mock_registry(const mock_registry&) = delete;
  mock_registry& operator=(const mock_registry&) = delete;

  network::network_address address() const;
  /// @returns the URL of its interfaces.
  std::string root() const;

  void be(registry_mood mood);
  /// Lists a service, whatever it says. @returns its id.
  std::string list(nlohmann::json service);
  /// Forgets all of them.
  void forget();

  /// @returns what it lists.
  std::vector<nlohmann::json> services() const;
  /// @returns what it was asked: "GET /mep/…", and how it answered: " 200".
  std::vector<std::string> asked() const;
  /// @returns how often that was asked.
  std::size_t times(const std::string& question) const;

private:
  class state;
  std::unique_ptr<state> state_;
};

/// @returns a ServiceInfo as a provider on this machine tells it.
nlohmann::json service_of(const std::string& provider, std::uint16_t port);

} // namespace sofof::test
