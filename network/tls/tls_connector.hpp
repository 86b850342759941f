// A vehicle's side: a port of this machine whose connections lead to a
// provider's tls_acceptor.
#pragma once

#include "network/keys/credentials.hpp"
#include "network/name_lookup.hpp"
#include "network/network_address.hpp"
#include "network/tls/tls_service.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace sofof::network {

/// Whom to connect to, and how long to try.
struct connector_options {
  network_address remote; ///< May be told later, by `lead_to`.
  std::string provider;   ///< Whom its certificate must name; empty: anybody.
  tls_service service = tls_service::provider; ///< Which one it is.
  name_resolver resolver = &resolve;
  std::chrono::milliseconds lookup_timeout{2000};
  /// From the addresses to a connection with one of them.
  std::chrono::milliseconds connect_timeout{1000};
  /// An address that does not answer for so long makes room for the next, and
  /// has another turn after the last: the system says again after a second
  /// only what got lost, and then after two.
  std::chrono::milliseconds turn{300};
  std::chrono::milliseconds handshake_timeout{2000};
  /// A connection through which nothing at all crosses for so long is closed,
  /// and so is one whose peer does not acknowledge for so long.
  std::chrono::milliseconds idle{2000};
  std::size_t most_connections = 16; ///< More are closed at once.
};

/// How vehicles connect to a provider of another host: what connects to `port`
/// is a tunnel to it, whose octets are not looked at.
class tls_connector {
public:
  /// Listens on 127.0.0.1 and carries each connection on to the remote host,
  /// on two threads of its own.
  /// @param own  Ours; the peer must show a provider's certificate of the same
  ///             CA. Null: bytes are carried as they are, without TLS, which
  ///             is for this machine only.
  /// @throws network_error when the credentials name no stations, and when the
  /// system has no more files.
  tls_connector(const credentials* own, connector_options options);
  /// Closes everything, and does not wait for the resolver.
  ~tls_connector();
  tls_connector(const tls_connector&) = delete;
  tls_connector& operator=(const tls_connector&) = delete;

  /// Closes all connections, soon; new ones are welcome. Any thread may ask for
  /// this.
  void hang_up();

  /// Leads to another host from now on; connections that are open stay. Any
  /// thread may call this.
  void lead_to(network_address remote);

  /// Goes by other credentials from now on, for connections that are opened
  /// later, and closes those to providers that they have revoked. Not for a
  /// connector without TLS. Any thread may call this.
  /// @throws network_error when they name no stations, or OpenSSL does not take
  /// them; then all stays as it was.
  void renew(const credentials& own);

  /// @returns the port of 127.0.0.1 that leads to the remote host.
  std::uint16_t port() const;

  /// @returns why there was no connection, or why the last one ended, as words
  /// about the remote host, "it"; empty while all is well. Any thread may
  /// ask; it is known before the local connection closes.
  std::string last_error() const;

private:
  class loop;
  std::unique_ptr<loop> loop_;
};

} // namespace sofof::network
