// Where others reach a process, and what it shows them.
#pragma once

#include "network/keys/key_ring.hpp"
#include "network/network_address.hpp"
#include "network/tls/tls_acceptor.hpp"
#include "scenario/runtime.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::scenario {

/// Reads the keys without which nothing may cross to another host.
/// @param option  Of the command line, that gave the address.
/// @param check   Of credentials that are read, now or later.
/// @returns what to show to others; null on this machine alone, unless it is
/// asked for.
/// @throws input_error, network_error, and what `check` throws.
std::shared_ptr<network::key_ring> load_keys(const network::network_address& at,
                                             const std::string& folder,
                                             std::string_view option,
                                             network::key_ring::user check);

/// Where the octets of an acceptor come in. It listens without TLS, on this
/// machine alone; before it, if it is secured, is a tls_acceptor.
class secure_listener {
public:
  /// @param keys  Null: it is not secured. Keys that are read again hold for
  ///              handshakes that begin later.
  secure_listener(std::shared_ptr<network::key_ring> keys,
                  network::network_address listen);

  /// @returns who is behind the connections that come by TLS.
  const network::peer_register& peers() const { return *peers_; }

  /// @returns how many handshakes were refused; once it is open, any thread may
  /// ask.
  std::uint64_t refused_handshakes() const {
    return tls_ ? tls_->counts().refused : 0;
  }

  /// @returns the address that others reach the acceptor at.
  /// @throws input_error, network_error.
  network::network_address
  open(network_runtime& time, const messages::acceptor_actor& acceptor,
       std::function<void(const std::string&)> on_refusal);

private:
  std::shared_ptr<network::key_ring> keys_;
  network::network_address listen_;
  std::shared_ptr<network::peer_register> peers_ =
      std::make_shared<network::peer_register>();
  std::optional<network::tls_acceptor> tls_;
};

} // namespace sofof::scenario
