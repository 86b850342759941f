// TLS 1.3 where both sides show certificates of our CA.
#pragma once

#include "network/keys/credentials.hpp"
#include "network/keys/openssl.hpp"
#include "network/tls/tls_service.hpp"

#include <memory>
#include <string>

namespace sofof::network {

/// Who opened a connection and who answered it.
enum class tls_side {
  opener,   ///< Shows stations, to a broker also a provider.
  answerer, ///< Shows a provider.
};

/// What handshakes begin with.
struct tls_context {
  credentials own;
  ssl_context_ptr settings;
  tls_service service = tls_service::provider;
};

/// TLS 1.3 and nothing older, no sessions that are resumed.
/// @param service  Which one answers: this process or its peer.
/// @throws network_error when OpenSSL does not take the credentials.
tls_context make_tls_context(const credentials& own,
                             tls_service service = tls_service::provider);

/// The handshake of a connection that does not block.
class tls_handshake {
public:
  enum class step { waits_to_read, waits_to_write, done, failed };

  /// @param socket  Connected; outlives this and what `release` returns.
  tls_handshake(const tls_context& context, int socket, tls_side side);

  /// Goes on as far as it can now.
  step advance();

  /// @returns whom the peer's certificate names; once it is done.
  const peer_identity& who() const { return notes_->verdict.who.value(); }

  /// @returns why it failed, with the peer as "it".
  const std::string& failure() const { return failure_; }

  /// @returns the connection, once it is done.
  ssl_ptr release() { return std::move(tls_); }

private:
  struct notes {
    credentials own;
    certificate_verdict verdict;
    tls_service service;
  };

  friend int judge_certificate(X509_STORE_CTX* asked, void*);

  std::unique_ptr<notes> notes_; // stays where it is, for OpenSSL
  ssl_ptr tls_;
  std::string failure_;
};

/// @returns OpenSSL's last error of this thread as words about the peer, "it";
/// forgets all.
std::string explain_tls_error();

} // namespace sofof::network
