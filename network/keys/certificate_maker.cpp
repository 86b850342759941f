// Certificates by OpenSSL, extension by extension.
#include "network/keys/certificate_maker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

namespace sofof::network {

namespace {

constexpr std::size_t longest_subject = 64; // letters
/// Clocks of hosts that have just started may be late.
constexpr long backdated_s = 3600;

/// A CA that gets into wrong hands is no good for web sites and mail: it may
/// name no address, and hosts and mailboxes only where there never are any (RFC
/// 5280, 4.2.1.10, and RFC 2606).
constexpr auto no_hosts =
    "critical,permitted;DNS:sofof.invalid,permitted;email:sofof.invalid,"
    "excluded;IP:0.0.0.0/0.0.0.0,"
    "excluded;IP:0:0:0:0:0:0:0:0/0:0:0:0:0:0:0:0";

std::array<unsigned char, 16> random_octets() {
  std::array<unsigned char, 16> octets{};
  require_openssl(RAND_bytes(octets.data(), octets.size()) == 1, "RAND_bytes");
  return octets;
}

/// @returns a certificate without names, extensions and signature.
x509_ptr blank_certificate(EVP_PKEY& key, int days) {
  x509_ptr certificate{X509_new()};
  require_openssl(certificate != nullptr, "making a certificate");
  auto* x = certificate.get();
  auto serial = random_octets();
  serial[0] = static_cast<unsigned char>((serial[0] & 0x7f) | 0x40);
  const std::unique_ptr<BIGNUM, decltype(&BN_free)> number{
      BN_bin2bn(serial.data(), serial.size(), nullptr), BN_free};
  require_openssl(
      X509_set_version(x, X509_VERSION_3) == 1 && number
          && BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(x))
          && X509_gmtime_adj(X509_getm_notBefore(x), -backdated_s)
          && X509_time_adj_ex(X509_getm_notAfter(x), days, 0, nullptr)
          && X509_set_pubkey(x, &key) == 1,
      "filling a certificate");
  return certificate;
}

void set_name(X509_NAME* name, const std::string& text) {
  require_openssl(X509_NAME_add_entry_by_txt(
                      name, "CN", MBSTRING_UTF8,
                      reinterpret_cast<const unsigned char*>(text.data()),
                      static_cast<int>(text.size()), -1, 0)
                      == 1,
                  "naming a certificate");
}

/// @param value  As in OpenSSL's configuration files.
void extend(X509& certificate, X509& issuer, int kind,
            const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, &issuer, &certificate, nullptr, nullptr, 0);
  const x509_extension_ptr extension{
      X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str())};
  require_openssl(extension
                      && X509_add_ext(&certificate, extension.get(), -1) == 1,
                  "extending a certificate");
}

void seal(X509& certificate, EVP_PKEY& key) {
  require_openssl(X509_sign(&certificate, &key, EVP_sha256()) > 0,
                  "signing a certificate");
}

std::string joined(const std::vector<std::string>& uris) {
  std::string text;
  for (const auto& uri : uris)
    text += (text.empty() ? "URI:" : ",URI:") + uri;
  return text;
}

std::vector<std::string> uris_of(const permitted_names& names) {
  auto all = network::uris_of(peer_identity{names.stations, {}});
  for (const auto& name : names.providers)
    std::ranges::copy(network::uris_of(peer_identity{{}, name}),
                      std::back_inserter(all));
  return all;
}

} // namespace

key_ptr make_key() {
  key_ptr key{EVP_EC_gen("P-256")};
  require_openssl(key != nullptr, "making a key");
  return key;
}

std::string to_pem(EVP_PKEY& key) {
  const bio_ptr bio{BIO_new(BIO_s_secmem())};
  require_openssl(bio
                      && PEM_write_bio_PKCS8PrivateKey(bio.get(), &key, nullptr,
                                                       nullptr, 0, nullptr,
                                                       nullptr)
                             == 1,
                  "writing a key");
  char* text = nullptr;
  const auto size = BIO_get_mem_data(bio.get(), &text);
  return {text, static_cast<std::size_t>(size)};
}

x509_ptr make_authority(EVP_PKEY& key, const permitted_names& names) {
  auto ca = blank_certificate(key, longest_validity_days);
  const auto tag = random_octets();
  // Different CAs have different names.
  set_name(X509_get_subject_name(ca.get()),
           fmt::format("SOFOF CA {:02x}{:02x}{:02x}{:02x}", tag[0], tag[1],
                       tag[2], tag[3]));
  require_openssl(
      X509_set_issuer_name(ca.get(), X509_get_subject_name(ca.get())) == 1,
      "naming a CA");
  extend(*ca, *ca, NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
  extend(*ca, *ca, NID_key_usage, "critical,keyCertSign,cRLSign");
  extend(*ca, *ca, NID_name_constraints, no_hosts);
  if (const auto uris = uris_of(names); !uris.empty())
    extend(*ca, *ca, NID_subject_alt_name, joined(uris));
  extend(*ca, *ca, NID_subject_key_identifier, "hash");
  extend(*ca, *ca, NID_authority_key_identifier, "keyid:always");
  seal(*ca, key);
  return ca;
}

x509_ptr make_certificate(EVP_PKEY& key, const peer_identity& who, int days,
                          X509& ca, EVP_PKEY& ca_key) {
  auto certificate = blank_certificate(key, days);
  auto& x = *certificate;
  // With a blank in it, it is taken for no host's name.
  set_name(X509_get_subject_name(&x), describe(who).substr(0, longest_subject));
  require_openssl(X509_set_issuer_name(&x, X509_get_subject_name(&ca)) == 1,
                  "naming an issuer");
  extend(x, ca, NID_basic_constraints, "critical,CA:FALSE");
  extend(x, ca, NID_key_usage, "critical,digitalSignature");
  extend(x, ca, NID_ext_key_usage,
         who.is_provider() ? "serverAuth" : "clientAuth");
  extend(x, ca, NID_subject_alt_name, joined(network::uris_of(who)));
  extend(x, ca, NID_subject_key_identifier, "hash");
  extend(x, ca, NID_authority_key_identifier, "keyid:always");
  seal(x, ca_key);
  return certificate;
}

} // namespace sofof::network
