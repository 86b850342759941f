// Where others reach a process, and what it shows them.
#pragma once

#include "network/keys/key_ring.hpp"
#include "network/network_address.hpp"
#include "network/tls/tls_acceptor.hpp"
#include "scenario/runtime.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace sofof {

/// Nobody outside may hear or say anything in plain words.
/// @param option  Of the command line, that gave the address.
/// @param check   Of credentials that are read, now or later.
/// @returns what to show to others; null on this machine alone, unless it is
/// asked for.
/// @throws input_error, network_error, and what `check` throws.
std::shared_ptr<key_ring> load_keys(const network_address& at,
                                    const std::string& folder,
                                    std::string_view option,
                                    key_ring::user check);

/// Where the bytes of a gate come in: it listens in plain words on this
/// machine, and in front of it, if it is secured, a door.
class front {
public:
  /// @param keys  Null: none. What is read again, the door goes by.
  front(std::shared_ptr<key_ring> keys, network_address listen);

  /// @returns who is behind the connections that its door carries.
  const peer_register& peers() const { return *peers_; }

  /// @returns the address that others reach the gate at.
  /// @throws input_error, network_error.
  network_address open(network_runtime& time, const gate_actor& gate,
                       std::function<void(const std::string&)> on_refusal);

private:
  std::shared_ptr<key_ring> keys_;
  network_address listen_;
  std::shared_ptr<peer_register> peers_ = std::make_shared<peer_register>();
  std::optional<tls_acceptor> door_;
};

} // namespace sofof
