// How OpenSSL's objects are freed, and its errors read.
#include "network/keys/openssl.hpp"

#include "network/network_error.hpp"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

namespace sofof::network {

void openssl_deleter::operator()(BIO* x) const {
  BIO_free_all(x);
}
void openssl_deleter::operator()(EVP_MD_CTX* x) const {
  EVP_MD_CTX_free(x);
}
void openssl_deleter::operator()(EVP_PKEY* x) const {
  EVP_PKEY_free(x);
}
void openssl_deleter::operator()(SSL* x) const {
  SSL_free(x);
}
void openssl_deleter::operator()(SSL_CTX* x) const {
  SSL_CTX_free(x);
}
void openssl_deleter::operator()(X509* x) const {
  X509_free(x);
}
void openssl_deleter::operator()(X509_EXTENSION* x) const {
  X509_EXTENSION_free(x);
}
void openssl_deleter::operator()(X509_STORE* x) const {
  X509_STORE_free(x);
}
void openssl_deleter::operator()(X509_STORE_CTX* x) const {
  X509_STORE_CTX_free(x);
}

void forget_openssl_errors() {
  ERR_clear_error();
}

std::string last_openssl_error() {
  const auto* words = ERR_reason_error_string(ERR_peek_last_error());
  std::string text = words ? words : "no reason given";
  ERR_clear_error();
  return text;
}

void require_openssl(bool ok, const char* what) {
  if (!ok)
    throw network_error{std::string{what}
                        + " failed in OpenSSL: " + last_openssl_error()};
}

} // namespace sofof::network
