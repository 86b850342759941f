// Reading and writing without waiting.
#include "network/tls/byte_stream.hpp"

#include "network/tls/tls.hpp"

#include <cassert>
#include <cerrno>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <system_error>

namespace sofof::network {

byte_stream::byte_stream(descriptor socket, ssl_ptr tls)
    : socket_{std::move(socket)}, tls_{std::move(tls)} {}

byte_stream::~byte_stream() {
  if (!tls_ || is_broken_)
    return;
  SSL_shutdown(tls_.get()); // what it complains of is forgotten by who is next
}

byte_stream::outcome byte_stream::read(std::span<std::byte> to) {
  assert(!to.empty());
  if (!tls_)
    return plain_outcome(recv(fd(), to.data(), to.size(), MSG_DONTWAIT));
  std::size_t moved = 0;
  forget_openssl_errors();
  const auto result = SSL_read_ex(tls_.get(), to.data(), to.size(), &moved);
  return tls_outcome(result, moved);
}

byte_stream::outcome byte_stream::write(std::span<const std::byte> from) {
  assert(!from.empty());
  if (!tls_) {
    const auto moved =
        send(fd(), from.data(), from.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (moved < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
      return {state::waits_to_write, 0};
    return plain_outcome(moved);
  }
  std::size_t moved = 0;
  forget_openssl_errors();
  const auto result =
      SSL_write_ex(tls_.get(), from.data(), from.size(), &moved);
  return tls_outcome(result, moved);
}

const X509* byte_stream::certificate() const {
  return tls_ ? SSL_get0_peer_certificate(tls_.get()) : nullptr;
}

byte_stream::outcome byte_stream::plain_outcome(long moved) {
  if (moved > 0)
    return {state::moved, static_cast<std::size_t>(moved)};
  if (moved == 0)
    return {state::closed, 0};
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)
    return {state::waits_to_read, 0};
  return broken(errno);
}

byte_stream::outcome byte_stream::tls_outcome(int result, std::size_t moved) {
  if (result == 1)
    return {state::moved, moved};
  const auto error = errno;
  switch (SSL_get_error(tls_.get(), result)) {
    case SSL_ERROR_WANT_READ:
      return {state::waits_to_read, 0};
    case SSL_ERROR_WANT_WRITE:
      return {state::waits_to_write, 0};
    case SSL_ERROR_ZERO_RETURN:
      return {state::closed, 0};
    case SSL_ERROR_SYSCALL:
      return broken(error);
    default:
      is_broken_ = true;
      failure_ = explain_tls_error();
      return {state::failed, 0};
  }
}

byte_stream::outcome byte_stream::broken(int error) {
  is_broken_ = true;
  // Whoever closes while something is on its way to him resets.
  if (error == ECONNRESET || error == EPIPE)
    return {state::closed, 0};
  failure_ = "the connection broke: " + std::generic_category().message(error);
  return {state::failed, 0};
}

} // namespace sofof::network
