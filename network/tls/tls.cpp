// TLS by OpenSSL: settings, whom to let in, and what its errors mean.
#include "network/tls/tls.hpp"

#include "network/network_error.hpp"

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

namespace sofof::network {

/// OpenSSL asks about a peer's certificate; `examine` knows.
int judge_certificate(X509_STORE_CTX* asked, void*) {
  auto* tls = static_cast<SSL*>(
      X509_STORE_CTX_get_ex_data(asked, SSL_get_ex_data_X509_STORE_CTX_idx()));
  auto& notes = *static_cast<tls_handshake::notes*>(SSL_get_app_data(tls));
  auto& verdict = notes.verdict;
  verdict = notes.own.examine(*X509_STORE_CTX_get0_cert(asked));
  const bool wants_provider = SSL_is_server(tls) == 0;
  const bool takes_both =
      !wants_provider && notes.service == tls_service::broker;
  if (verdict.who && !takes_both
      && verdict.who->is_provider() != wants_provider)
    verdict = {{},
               "names " + describe(*verdict.who)
                   + (wants_provider ? ", not a provider" : ", no station"),
               X509_V_ERR_INVALID_PURPOSE};
  X509_STORE_CTX_set_error(asked, verdict.error);
  return verdict.who ? 1 : 0;
}

tls_context make_tls_context(const credentials& own, tls_service service) {
  ssl_context_ptr context{SSL_CTX_new(TLS_method())};
  auto* c = context.get();
  require_openssl(c && SSL_CTX_set_min_proto_version(c, TLS1_3_VERSION) == 1
                      && SSL_CTX_set1_groups_list(c, "X25519:P-256") == 1
                      && SSL_CTX_use_certificate(c, &own.certificate()) == 1
                      && SSL_CTX_use_PrivateKey(c, &own.key()) == 1
                      && SSL_CTX_set_num_tickets(c, 0) == 1,
                  "setting up TLS");
  constexpr int security_level = 2; // 112 bits
  SSL_CTX_set_security_level(c, security_level);
  SSL_CTX_set1_cert_store(c, &own.trusted());
  SSL_CTX_set_verify(c, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT,
                     nullptr);
  SSL_CTX_set_cert_verify_callback(c, judge_certificate, nullptr);
  SSL_CTX_set_max_cert_list(c, static_cast<long>(largest_certificate));
  SSL_CTX_set_session_cache_mode(c, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_mode(c, SSL_MODE_ENABLE_PARTIAL_WRITE
                          | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER
                          | SSL_MODE_RELEASE_BUFFERS);
  // Who goes without a word has closed, too; what is carried knows its own end.
  SSL_CTX_set_options(c, SSL_OP_IGNORE_UNEXPECTED_EOF);
  // Else one call would read as long as a peer sends what is no data.
  SSL_CTX_clear_mode(c, SSL_MODE_AUTO_RETRY);
  return {own, std::move(context), service};
}

tls_handshake::tls_handshake(const tls_context& context, int socket,
                             tls_side side)
    : notes_{new notes{context.own, {}, context.service}},
      tls_{SSL_new(context.settings.get())} {
  require_openssl(tls_ && SSL_set_fd(tls_.get(), socket) == 1, "beginning TLS");
  SSL_set_app_data(tls_.get(), notes_.get());
  if (side == tls_side::answerer)
    SSL_set_accept_state(tls_.get());
  else
    SSL_set_connect_state(tls_.get());
}

tls_handshake::step tls_handshake::advance() {
  forget_openssl_errors();
  const auto result = SSL_do_handshake(tls_.get());
  if (result == 1) {
    SSL_set_app_data(tls_.get(), nullptr);
    return step::done;
  }
  switch (SSL_get_error(tls_.get(), result)) {
    case SSL_ERROR_WANT_READ:
      return step::waits_to_read;
    case SSL_ERROR_WANT_WRITE:
      return step::waits_to_write;
    default:
      break;
  }
  const auto& refusal = notes_->verdict.refusal;
  failure_ =
      refusal.empty() ? explain_tls_error() : "its certificate " + refusal;
  return step::failed;
}

std::string explain_tls_error() {
  const auto error = ERR_peek_error();
  const auto words = last_openssl_error();
  if (error == 0)
    return "it hung up";
  if (ERR_GET_LIB(error) != ERR_LIB_SSL)
    return "TLS failed: " + words;
  switch (ERR_GET_REASON(error)) {
    case SSL_R_UNEXPECTED_EOF_WHILE_READING:
      return "it hung up";
    case SSL_R_WRONG_VERSION_NUMBER:
    case SSL_R_HTTP_REQUEST:
    case SSL_R_HTTPS_PROXY_REQUEST:
      return "it does not speak TLS";
    case SSL_R_UNSUPPORTED_PROTOCOL:
    case SSL_R_TLSV1_ALERT_PROTOCOL_VERSION:
      return "it does not speak TLS 1.3";
    case SSL_R_PEER_DID_NOT_RETURN_A_CERTIFICATE:
      return "it shows no certificate";
    case SSL_R_TLSV13_ALERT_CERTIFICATE_REQUIRED:
      return "it wants to see a certificate";
    case SSL_R_TLSV1_ALERT_UNKNOWN_CA:
      return "it does not trust the CA of our certificate";
    case SSL_R_SSLV3_ALERT_CERTIFICATE_REVOKED:
      return "our certificate has been revoked";
    case SSL_R_SSLV3_ALERT_CERTIFICATE_EXPIRED:
      return "it takes our certificate for expired: do the clocks agree?";
    case SSL_R_SSLV3_ALERT_BAD_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_UNSUPPORTED_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_UNKNOWN:
    case SSL_R_SSLV3_ALERT_HANDSHAKE_FAILURE:
      return "it does not accept our certificate";
    default:
      return "TLS failed: " + words;
  }
}

} // namespace sofof::network
