// OpenSSL's objects as owners that free them.
#pragma once

#include <memory>
#include <openssl/types.h>
#include <string>

struct X509_extension_st;

namespace sofof::network {

struct openssl_deleter {
  void operator()(BIO* x) const;
  void operator()(EVP_MD_CTX* x) const;
  void operator()(EVP_PKEY* x) const;
  void operator()(SSL* x) const;
  void operator()(SSL_CTX* x) const;
  void operator()(X509* x) const;
  void operator()(X509_extension_st* x) const;
  void operator()(X509_STORE* x) const;
  void operator()(X509_STORE_CTX* x) const;
};

using bio_ptr = std::unique_ptr<BIO, openssl_deleter>;
using digest_ptr = std::unique_ptr<EVP_MD_CTX, openssl_deleter>;
using key_ptr = std::unique_ptr<EVP_PKEY, openssl_deleter>;
using ssl_ptr = std::unique_ptr<SSL, openssl_deleter>;
using ssl_context_ptr = std::unique_ptr<SSL_CTX, openssl_deleter>;
using x509_ptr = std::unique_ptr<X509, openssl_deleter>;
using x509_extension_ptr = std::unique_ptr<X509_extension_st, openssl_deleter>;
using x509_store_ptr = std::unique_ptr<X509_STORE, openssl_deleter>;
using x509_check_ptr = std::unique_ptr<X509_STORE_CTX, openssl_deleter>;

/// Forgets the errors of earlier calls; to be called before those that leave
/// some behind.
void forget_openssl_errors();

/// @returns OpenSSL's words for its last error of this thread, and forgets all.
std::string last_openssl_error();

/// For calls that only fail for want of memory or by a mistake of ours.
/// @throws network_error, saying what failed, unless `ok`.
void require_openssl(bool ok, const char* what);

} // namespace sofof::network
