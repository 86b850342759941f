// A provider's side of TLS: lets in who shows a certificate of our CAs, for as
// long as it is good, and carries the bytes between them and a port of this
// machine.
#pragma once

#include "base/random.hpp"
#include "network/keys/credentials.hpp"
#include "network/network_address.hpp"
#include "network/tls/peer_register.hpp"
#include "network/tls/tls_service.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace sofof::network {

/// Where to listen, and for how much of what.
struct acceptor_options {
  network_address listen;       ///< Port 0: any that is free.
  std::uint16_t inner_port = 0; ///< On 127.0.0.1, where the bytes go.
  tls_service service = tls_service::provider; ///< Which one is there.
  /// From the first packet to the connection with `inner_port`.
  std::chrono::milliseconds handshake_timeout{2000};
  /// A connection through which nothing at all crosses for so long is closed,
  /// and so is one whose peer does not acknowledge for so long.
  std::chrono::milliseconds idle{2000};
  /// Unfinished ones. For one more, one of the network that has the most of
  /// them makes room (network/tls/fair_share.hpp).
  std::size_t most_handshakes = 256;
  /// Choose which one; for peers that cannot guess them, of a secret seed.
  random_stream draws{0, "handshakes"};
  std::size_t most_connections = 512;
  std::size_t most_per_peer = 16; ///< Connections per identity.
  /// Knows who is behind each connection with `inner_port`; may be null.
  std::shared_ptr<peer_register> peers;
  /// Told who was refused or distrusted later, and why, in a sentence without
  /// its full stop, at most once a second; on the acceptor's thread; must not
  /// block or throw.
  std::function<void(const std::string&)> on_refusal;
};

/// What has become of connections.
struct acceptor_counts {
  std::uint64_t accepted = 0; ///< Connections carried, since the start.
  std::uint64_t refused = 0;  ///< Connections not carried, since the start.
  std::size_t open = 0;       ///< Connections carried now.
};

/// Where vehicles of other hosts connect to a provider. A connection that has
/// been let in is a tunnel to `inner_port`, whose octets are not looked at.
class tls_acceptor {
public:
  /// Listens, on two threads of its own: handshakes on one, connections on the
  /// other.
  /// @throws network_error when the credentials are no provider's, and when it
  /// cannot listen.
  tls_acceptor(const credentials& own, acceptor_options options);
  /// Closes everything.
  ~tls_acceptor();
  tls_acceptor(const tls_acceptor&) = delete;
  tls_acceptor& operator=(const tls_acceptor&) = delete;

  /// Goes by other credentials from now on, for handshakes that begin later,
  /// and closes the connections of peers that they have revoked. Nobody else
  /// notices. Any thread may call this.
  /// @throws network_error when they are no provider's, or OpenSSL does not
  /// take them; then all stays as it was.
  void renew(const credentials& own);

  /// @returns the port it listens at.
  std::uint16_t port() const;

  /// Any thread may ask.
  acceptor_counts counts() const;

private:
  class loop;
  std::unique_ptr<loop> loop_;
};

} // namespace sofof::network
