// How a private CA and its certificates are made.
#include "network/key_store.hpp"

#include "network/certificate.hpp"
#include "network/network_error.hpp"
#include "network/new_file.hpp"
#include "network/station_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <system_error>

namespace sofof {

namespace fs = std::filesystem;

namespace {

constexpr mode_t for_all = 0644;
constexpr mode_t for_owner = 0600;
/// What a folder is called, and a subject, may not be longer; letters.
constexpr std::size_t longest_subject = 64;
/// Clocks of hosts that have just started may be late.
constexpr long backdated_s = 3600;

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

x509_ptr make_ca(EVP_PKEY& key) {
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
  extend(*ca, *ca, NID_subject_key_identifier, "hash");
  extend(*ca, *ca, NID_authority_key_identifier, "keyid:always");
  seal(*ca, key);
  return ca;
}

std::string joined_uris(const peer_identity& who) {
  std::string text;
  for (const auto& uri : uris_of(who))
    text += (text.empty() ? "URI:" : ",URI:") + uri;
  return text;
}

/// @returns "provider-mec", "station-101-106", "station-7_101-106" or, where
/// that is too long, "station-7-and-55-more".
std::string folder_name(const peer_identity& who) {
  if (who.is_provider())
    return "provider-" + who.provider;
  auto name = "station-" + print_stations(who.stations);
  std::ranges::replace(name, ',', '_');
  if (name.size() > longest_subject)
    name = fmt::format("station-{}-and-{}-more", who.stations.front(),
                       who.stations.size() - 1);
  return name;
}

x509_ptr make_certificate(EVP_PKEY& key, const peer_identity& who, int days,
                          X509& ca, EVP_PKEY& ca_key) {
  auto certificate = blank_certificate(key, days);
  auto& x = *certificate;
  set_name(X509_get_subject_name(&x),
           folder_name(who).substr(0, longest_subject));
  require_openssl(X509_set_issuer_name(&x, X509_get_subject_name(&ca)) == 1,
                  "naming an issuer");
  extend(x, ca, NID_basic_constraints, "critical,CA:FALSE");
  extend(x, ca, NID_key_usage, "critical,digitalSignature");
  extend(x, ca, NID_ext_key_usage,
         who.is_provider() ? "serverAuth" : "clientAuth");
  extend(x, ca, NID_subject_alt_name, joined_uris(who));
  extend(x, ca, NID_subject_key_identifier, "hash");
  extend(x, ca, NID_authority_key_identifier, "keyid:always");
  seal(x, ca_key);
  return certificate;
}

std::string read_small_file(const fs::path& path) {
  std::ifstream in{path, std::ios::binary};
  std::string text(largest_certificate, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw network_error{fmt::format("cannot make the folder {}: {}; choose "
                                    "another",
                                    folder.string(), error.message())};
}

void refuse_existing(const fs::path& path, const char* advice) {
  std::error_code none;
  if (fs::exists(fs::symlink_status(path, none)))
    throw network_error{
        fmt::format("{} is there already: {}", path.string(), advice)};
}

/// A folder on its way to its name; gone with its owner when it never got it.
class unfinished_folder {
public:
  explicit unfinished_folder(const fs::path& final_path)
      : final_{final_path}, name_{final_path.string() + ".XXXXXX"} {
    if (!mkdtemp(name_.data()))
      refuse();
  }
  ~unfinished_folder() {
    std::error_code ignored;
    fs::remove_all(name_, ignored);
  }
  unfinished_folder(const unfinished_folder&) = delete;
  unfinished_folder& operator=(const unfinished_folder&) = delete;

  fs::path operator/(const char* file) const { return fs::path{name_} / file; }
  void finish() const {
    constexpr mode_t folder_for_all = 0755;
    if (chmod(name_.c_str(), folder_for_all) != 0
        || std::rename(name_.c_str(), final_.c_str()) != 0)
      refuse();
  }

private:
  [[noreturn]] void refuse() const {
    throw network_error{
        fmt::format("cannot write {}: {}; choose another folder with --out",
                    final_.string(), std::generic_category().message(errno))};
  }

  fs::path final_;
  std::string name_;
};

void check_wish(const peer_identity& who, const issue_options& options) {
  if (options.days < 1 || options.days > longest_validity_days)
    throw network_error{
        fmt::format("a certificate cannot be valid for {} days: 1 to {} can be",
                    options.days, longest_validity_days)};
  if (who.stations.empty() && !is_provider_name(who.provider))
    throw network_error{fmt::format(
        "'{}' cannot name a provider: letters, digits, '.', '-' and '_' can, a "
        "letter or digit first, 63 at most",
        who.provider)};
  const auto uris = uris_of(who);
  if (identity_of(uris) != who)
    throw network_error{fmt::format("a certificate names a provider or 1 to {} "
                                    "stations, each once and in order",
                                    most_stations)};
}

} // namespace

void init_keys(const fs::path& folder) {
  const auto ca_file = folder / "ca.pem";
  const auto key_file = folder / "ca_key.pem";
  constexpr auto advice = "a new CA would make all its certificates worthless; "
                          "choose another folder";
  refuse_existing(ca_file, advice);
  refuse_existing(key_file, advice);
  make_folder(folder);
  const auto key = make_key();
  const auto ca = make_ca(*key);
  write_new_file(key_file, to_pem(*key), for_owner);
  write_new_file(ca_file, to_pem(*ca), for_all);
}

fs::path issue_keys(const fs::path& folder, const peer_identity& who,
                    const issue_options& options) {
  check_wish(who, options);
  const auto ca = certificate_from_pem(read_small_file(folder / "ca.pem"));
  const auto ca_key = key_from_pem(read_small_file(folder / "ca_key.pem"));
  if (!ca || !ca_key || X509_check_private_key(ca.get(), ca_key.get()) != 1) {
    forget_openssl_errors();
    throw network_error{fmt::format(
        "{} holds no CA that can be read: `sofof keys init` makes one",
        folder.string())};
  }
  if (X509_cmp_time(X509_get0_notAfter(ca.get()), nullptr) <= 0)
    throw network_error{
        fmt::format("the CA in {} has expired: `sofof keys init` makes another",
                    folder.string())};
  const auto key = make_key();
  const auto certificate =
      make_certificate(*key, who, options.days, *ca, *ca_key);
  if (ASN1_TIME_compare(X509_get0_notAfter(certificate.get()),
                        X509_get0_notAfter(ca.get()))
      > 0)
    throw network_error{fmt::format(
        "the CA in {} ends within {} days: choose fewer with --days, or make "
        "another CA with `sofof keys init`",
        folder.string(), options.days)};
  const auto text = to_pem(*certificate);
  if (text.size() > largest_certificate)
    throw network_error{"so many single stations do not fit into one "
                        "certificate: use ranges, or several certificates"};
  const auto wanted = options.out.value_or(folder / folder_name(who));
  // "keys/" and "keys" are the same folder, but only one of them has a name.
  auto target = wanted.has_filename() ? wanted : wanted.parent_path();
  refuse_existing(target, "remove it, or choose another folder with --out");
  if (target.has_parent_path())
    make_folder(target.parent_path());
  const unfinished_folder out{target};
  write_new_file(out / "ca.pem", to_pem(*ca), for_all);
  write_new_file(out / "cert.pem", text, for_all);
  write_new_file(out / "key.pem", to_pem(*key), for_owner);
  out.finish();
  return target;
}

} // namespace sofof
