// What a provider's host and a vehicle's host need, on one machine.
#pragma once

#include "network/tls/tls.hpp"
#include "network/tls/tls_acceptor.hpp"
#include "network/tls/tls_connector.hpp"
#include "tests/network/key_folder.hpp"
#include "tests/network/loopback.hpp"
#include "tests/support/contains.hpp"

#include <string>
#include <string_view>

namespace sofof::test {

/// Timeouts that nobody meets who does not hang.
inline network::acceptor_options acceptor_to(std::uint16_t inner_port,
                                             sentences* heard = nullptr) {
  network::acceptor_options options;
  options.listen = {"127.0.0.1", 0};
  options.inner_port = inner_port;
  options.handshake_timeout = patience;
  options.idle = patience;
  if (heard)
    options.on_refusal = heard->listener();
  return options;
}

inline network::connector_options connector_to(std::uint16_t port) {
  network::connector_options options;
  options.remote = {"127.0.0.1", port};
  options.connect_timeout = patience;
  options.handshake_timeout = patience;
  options.idle = patience;
  return options;
}

/// @returns whether the far end of a line sends back what it gets.
inline bool echoes(const plug& line, std::string_view text) {
  return line.send(text) && line.receive(text.size()) == to_bytes(text);
}

} // namespace sofof::test
