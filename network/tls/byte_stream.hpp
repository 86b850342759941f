// One side of a tunnel: a connection that does not block, plain or with TLS.
#pragma once

#include "network/keys/openssl.hpp"
#include "network/socket.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace sofof::network {

/// Reads and writes what goes at once, and says what to wait for otherwise. Of
/// one thread at a time.
class byte_stream {
public:
  enum class state {
    moved,          ///< Some bytes have been read or written.
    waits_to_read,  ///< For the socket to become readable.
    waits_to_write, ///< For the socket to become writable.
    closed,         ///< By the peer.
    failed,         ///< It broke: `failure` says why.
  };
  struct outcome {
    state what = state::moved;
    std::size_t size = 0; ///< Bytes moved, > 0; 0 in all other states.
  };

  /// @param tls  After its handshake; none: plain.
  explicit byte_stream(descriptor socket, ssl_ptr tls = {});
  byte_stream(byte_stream&&) noexcept = default;
  /// Tells the peer that this is the end, if it goes at once.
  ~byte_stream();

  /// Takes bytes that have come.
  /// @param to  At least one byte.
  outcome read(std::span<std::byte> to);
  /// Sends bytes.
  /// @param from  At least one byte; the same ones again after a wait.
  outcome write(std::span<const std::byte> from);

  int fd() const { return socket_.get(); }
  /// @returns the certificate that the peer has shown; null: plain.
  const X509* certificate() const;
  /// @returns why it failed, with the peer as "it".
  const std::string& failure() const { return failure_; }

private:
  outcome plain_outcome(long moved);
  outcome tls_outcome(int result, std::size_t moved);
  outcome broken(int error);

  descriptor socket_;
  ssl_ptr tls_;            // goes before its socket
  bool is_broken_ = false; ///< Nothing can be sent any more.
  std::string failure_;
};

} // namespace sofof::network
