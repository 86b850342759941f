// The addresses of a host, without waiting for whoever knows them.
#pragma once

#include "network/network_address.hpp"
#include "network/socket.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace sofof::network {

/// How a host becomes addresses; may take as long as it likes.
using name_resolver =
    std::function<std::vector<socket_address>(const network_address&)>;

/// One question to a resolver, on a thread that nobody waits for: a resolver
/// cannot be interrupted, and may outlive who has asked.
class name_lookup {
public:
  /// Asks.
  /// @param wake  Called once the answer is there.
  /// @throws std::system_error when the system has no more threads.
  name_lookup(const name_resolver& resolve, const network_address& host,
              std::shared_ptr<wake_up> wake);

  /// @returns all addresses, best first; nullopt: not yet.
  std::optional<std::vector<socket_address>> answer() const;

private:
  struct question;
  std::shared_ptr<question> question_;
};

} // namespace sofof::network
