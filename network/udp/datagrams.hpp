// Datagrams to one address, and those that others send here.
#pragma once

#include "network/network_address.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace sofof::network {

/// UDP. What is sent may get lost; what comes is handed on by a thread of its
/// own, and no more than `most_per_second` of it.
class datagrams {
public:
  static constexpr double most_per_second = 2000;

  /// @param from  Where to hear; nullopt: what is answered alone.
  /// @param hear  Gets each datagram of at most `longest` octets; on the own
  ///              thread.
  /// @throws network_error when there is no such address, or it is taken.
  datagrams(const network_address& to,
            const std::optional<network_address>& from, std::size_t longest,
            std::function<void(std::span<const std::byte>)> hear);
  /// Hands on nothing any more.
  ~datagrams();
  datagrams(const datagrams&) = delete;
  datagrams& operator=(const datagrams&) = delete;

  /// For one thread at once. Never waits: what the system does not take is
  /// lost.
  void send(std::span<const std::byte> datagram);

  /// @returns where it hears.
  network_address address() const;

private:
  class state;
  std::unique_ptr<state> state_;
};

} // namespace sofof::network
