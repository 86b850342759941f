// The broker as a process of its own.
#pragma once

#include "network/network_address.hpp"

#include <atomic>
#include <iosfwd>
#include <optional>
#include <string>

namespace sofof::scenario {

struct broker_service_options {
  network::network_address listen;
  std::string keys; ///< Folder with certificate and key; empty on loopback.
  /// Once true, the folder is read again, and this is false again.
  std::atomic<bool>* keys_have_changed = nullptr;
  std::optional<network::network_address> metrics; ///< Where to serve figures.
};

/// Runs a broker until it is interrupted. With keys it lets in who shows a
/// certificate of the same CA, and its own has to name the provider `broker`.
/// @param console  Gets where it listens, and who was refused.
/// @throws input_error, network_error.
void run_broker(const broker_service_options& what,
                const std::atomic<bool>& interrupted, std::ostream& console);

} // namespace sofof::scenario
