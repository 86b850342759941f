// TCP sockets that never block, and their owner.
#pragma once

#include "base/files/descriptor.hpp"
#include "network/network_address.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <sys/socket.h>
#include <vector>

namespace sofof::network {

/// An address as the system wants it.
struct socket_address {
  sockaddr_storage storage{};
  socklen_t size = 0;
};

/// @returns e.g. "10.0.0.1:4711".
std::string print_address(const socket_address& address);

/// Listens at the first address that the host has.
/// @throws network_error when that cannot be.
descriptor listen_at(const network_address& address);

/// @returns the port that a socket got.
std::uint16_t port_of(const descriptor& socket);

/// A connection that somebody opened, or why there is none.
struct accepted_socket {
  descriptor socket; ///< None: nobody waits, or the system has no more.
  socket_address peer;
  int error = 0; ///< EAGAIN: nobody waits.
};

/// Takes the next connection; it sends small messages at once.
accepted_socket accept_from(const descriptor& listener);

/// Asks the resolver, which may take seconds unless the host is a number.
/// @returns all addresses of a host, best first; none when it has none.
std::vector<socket_address> resolve(const network_address& address);

/// A connection on its way, or why there is none.
struct started_connection {
  descriptor socket; ///< Writable as soon as it is decided.
  int error = 0;
};

/// Begins to connect; the connection will send small messages at once.
/// @param on_bound  Told the own port before anything is sent from it, on
///                  connections within this machine alone; may be empty.
started_connection
start_connecting(const socket_address& address,
                 const std::function<void(std::uint16_t)>& on_bound = {});

/// @returns the address of a port of this machine, for its own processes.
socket_address loopback_port(std::uint16_t port);

/// @returns how a started connection was decided: 0, or what was wrong.
int connection_error(const descriptor& socket);

/// Gives a connection up when the peer has not taken what was sent to it for
/// so long; otherwise the system tries for a quarter of an hour.
void give_up_after(const descriptor& socket, std::chrono::milliseconds silence);

/// Wakes a thread that polls.
class wake_up {
public:
  wake_up();
  /// Makes `fd` readable.
  void call();
  /// Makes it unreadable again.
  void answer();
  int fd() const { return event_.get(); }

private:
  descriptor event_;
};

} // namespace sofof::network
