// Certificates read, written and judged by OpenSSL.
#include "network/keys/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <vector>

namespace sofof::network {

namespace {

/// 112 bits: what OpenSSL calls security level 2.
constexpr int security_level = 2;

struct names_deleter {
  void operator()(GENERAL_NAMES* x) const { GENERAL_NAMES_free(x); }
};
using names_ptr = std::unique_ptr<GENERAL_NAMES, names_deleter>;

bio_ptr reader_of(std::string_view text) {
  bio_ptr bio;
  if (text.size() <= largest_certificate)
    bio.reset(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
  return bio;
}

/// Asks nobody for a password.
int no_password(char*, int, int, void*) {
  return -1;
}

std::vector<std::string> uris_in(const X509& certificate) {
  std::vector<std::string> uris;
  const names_ptr names{static_cast<GENERAL_NAMES*>(
      X509_get_ext_d2i(&certificate, NID_subject_alt_name, nullptr, nullptr))};
  for (int i = 0; names && i < sk_GENERAL_NAME_num(names.get()); ++i) {
    const auto* name = sk_GENERAL_NAME_value(names.get(), i);
    if (name->type != GEN_URI)
      continue;
    const auto* text = name->d.uniformResourceIdentifier;
    uris.emplace_back(
        reinterpret_cast<const char*>(ASN1_STRING_get0_data(text)),
        static_cast<std::size_t>(ASN1_STRING_length(text)));
  }
  return uris;
}

std::string print_time(const ASN1_TIME* time) {
  std::tm t{};
  if (ASN1_TIME_to_tm(time, &t) != 1)
    return "an unreadable time";
  constexpr auto first_year = 1900;
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02} UTC",
                     t.tm_year + first_year, t.tm_mon + 1, t.tm_mday, t.tm_hour,
                     t.tm_min);
}

std::string explain(int error, int depth, X509& certificate) {
  switch (error) {
    case X509_V_ERR_CERT_HAS_EXPIRED:
      return depth > 0 ? "is signed by a CA that has expired"
                       : "has expired on "
                             + print_time(X509_get0_notAfter(&certificate));
    case X509_V_ERR_CERT_NOT_YET_VALID:
      return depth > 0 ? "is signed by a CA that is not yet valid"
                       : "is not valid before "
                             + print_time(X509_get0_notBefore(&certificate));
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
    case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
    case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
    case X509_V_ERR_CERT_SIGNATURE_FAILURE:
      return "is not signed by this CA";
    case X509_V_ERR_INVALID_PURPOSE:
      return "is not made for what it names";
    case X509_V_ERR_EXCLUDED_VIOLATION:
    case X509_V_ERR_PERMITTED_VIOLATION:
      return "names a host or a mailbox, which its CA may not name";
    default:
      return std::string{"is refused: "} + X509_verify_cert_error_string(error);
  }
}

/// @returns the CA that has signed a certificate that was accepted.
const X509* issuer_in(X509_STORE_CTX& check) {
  constexpr int issuer = 1;
  auto* chain = X509_STORE_CTX_get0_chain(&check);
  return sk_X509_num(chain) > issuer ? sk_X509_value(chain, issuer) : nullptr;
}

/// A CA with names of its own signs for no others. X.509 has no constraints for
/// URIs without a host.
bool may_name(const X509& ca, const peer_identity& who) {
  const auto permitted = uris_in(ca);
  if (permitted.empty())
    return true;
  if (who.is_provider())
    return std::ranges::count(permitted, uris_of(who).front()) > 0;
  std::vector<std::string> stations;
  for (const auto& uri : permitted)
    if (uri.starts_with(station_prefix))
      stations.push_back(uri);
  const auto all = identity_of(stations);
  return all && std::ranges::includes(all->stations, who.stations);
}

} // namespace

x509_ptr certificate_from_pem(std::string_view pem) {
  const auto bio = reader_of(pem);
  x509_ptr certificate;
  if (bio)
    certificate.reset(
        PEM_read_bio_X509(bio.get(), nullptr, no_password, nullptr));
  forget_openssl_errors();
  return certificate;
}

std::vector<x509_ptr> certificates_from_pem(std::string_view pem) {
  const auto bio = reader_of(pem);
  std::vector<x509_ptr> all;
  while (bio) {
    all.emplace_back(
        PEM_read_bio_X509(bio.get(), nullptr, no_password, nullptr));
    if (all.back())
      continue;
    all.pop_back();
    // The end of the text, or something else.
    if (ERR_GET_REASON(ERR_peek_last_error()) != PEM_R_NO_START_LINE)
      all.clear();
    break;
  }
  forget_openssl_errors();
  return all;
}

std::string to_pem(X509& certificate) {
  const bio_ptr bio{BIO_new(BIO_s_mem())};
  require_openssl(bio && PEM_write_bio_X509(bio.get(), &certificate) == 1,
                  "writing a certificate");
  char* text = nullptr;
  const auto size = BIO_get_mem_data(bio.get(), &text);
  return {text, static_cast<std::size_t>(size)};
}

key_ptr key_from_pem(std::string_view pem) {
  const auto bio = reader_of(pem);
  key_ptr key;
  if (bio)
    key.reset(
        PEM_read_bio_PrivateKey(bio.get(), nullptr, no_password, nullptr));
  forget_openssl_errors();
  return key;
}

x509_store_ptr store_of(std::span<const x509_ptr> authorities) {
  x509_store_ptr store{X509_STORE_new()};
  require_openssl(store != nullptr, "trusting a CA");
  for (const auto& ca : authorities)
    require_openssl(X509_STORE_add_cert(store.get(), ca.get()) == 1,
                    "trusting a CA");
  return store;
}

std::string serial_of(const X509& certificate) {
  const std::unique_ptr<BIGNUM, decltype(&BN_free)> number{
      ASN1_INTEGER_to_BN(X509_get0_serialNumber(&certificate), nullptr),
      BN_free};
  char* text = number ? BN_bn2hex(number.get()) : nullptr;
  require_openssl(text != nullptr, "reading a serial number");
  std::string serial = text;
  OPENSSL_free(text);
  return serial;
}

bool has_expired(const X509& certificate) {
  return X509_cmp_current_time(X509_get0_notAfter(&certificate)) <= 0;
}

std::int64_t last_second_of(const X509& certificate) {
  std::tm when{};
  require_openssl(ASN1_TIME_to_tm(X509_get0_notAfter(&certificate), &when) == 1,
                  "read the end of a certificate");
  return timegm(&when);
}

std::string end_of(const X509& certificate) {
  return print_time(X509_get0_notAfter(&certificate));
}

certificate_verdict examine(X509& certificate, X509_STORE& trusted,
                            validity when) {
  const auto uris = uris_in(certificate);
  auto who = identity_of(uris);
  const x509_check_ptr check{X509_STORE_CTX_new()};
  require_openssl(
      check
          && X509_STORE_CTX_init(check.get(), &trusted, &certificate, nullptr)
                 == 1,
      "checking a certificate");
  auto* rules = X509_STORE_CTX_get0_param(check.get());
  X509_VERIFY_PARAM_set_auth_level(rules, security_level);
  X509_VERIFY_PARAM_set_flags(rules, X509_V_FLAG_X509_STRICT);
  if (when == validity::ever)
    X509_VERIFY_PARAM_set_flags(rules, X509_V_FLAG_NO_CHECK_TIME);
  if (who)
    X509_STORE_CTX_set_purpose(check.get(), who->is_provider()
                                                ? X509_PURPOSE_SSL_SERVER
                                                : X509_PURPOSE_SSL_CLIENT);
  const auto signed_and_valid = X509_verify_cert(check.get()) == 1;
  forget_openssl_errors();
  if (!signed_and_valid) {
    const auto error = X509_STORE_CTX_get_error(check.get());
    const auto depth = X509_STORE_CTX_get_error_depth(check.get());
    return {{}, explain(error, depth, certificate), error};
  }
  if (!who)
    return {{},
            "names no station and no provider",
            X509_V_ERR_APPLICATION_VERIFICATION};
  if (const auto* ca = issuer_in(*check); ca && !may_name(*ca, *who))
    return {{},
            "names " + describe(*who) + ", which its CA may not name",
            X509_V_ERR_PERMITTED_VIOLATION};
  return {std::move(who), {}, X509_V_OK};
}

} // namespace sofof::network
