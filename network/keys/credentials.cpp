// Loading credentials, signing, and checking signatures of others.
#include "network/keys/credentials.hpp"

#include "base/files/regular_file.hpp"
#include "network/keys/secret_file.hpp"
#include "network/network_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <openssl/evp.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <utility>

namespace sofof::network {

namespace {

/// Goes before whatever is signed, so that a signature is of no use elsewhere.
constexpr std::string_view purpose = "sofof proof 1\n";

constexpr auto remedy = "`sofof keys issue` makes it anew";

std::string read_pem(const std::filesystem::path& path) {
  auto content = read_regular_file(path, largest_certificate);
  if (content.error == EFBIG)
    throw network_error{
        fmt::format("{} is too long to be right: {}", path.string(), remedy)};
  if (!content.refusal.empty())
    throw network_error{fmt::format(
        "cannot read {}: {}; {} in a folder that you can read", path.string(),
        content.refusal,
        content.error == ENOENT ? "`sofof keys issue` makes it" : remedy)};
  return std::move(content.text);
}

x509_ptr read_certificate(const std::filesystem::path& path) {
  auto certificate = certificate_from_pem(read_pem(path));
  if (!certificate)
    throw network_error{
        fmt::format("{} is not a certificate: {}", path.string(), remedy)};
  return certificate;
}

std::vector<x509_ptr> read_authorities(const std::filesystem::path& path) {
  auto all = certificates_from_pem(read_pem(path));
  if (all.empty())
    throw network_error{
        fmt::format("{} is not a certificate: {}", path.string(), remedy)};
  for (const auto& ca : all)
    if (X509_check_ca(ca.get()) != 1)
      throw network_error{
          fmt::format("{} is not the certificate of a CA: copy the one that "
                      "`sofof keys init` wrote",
                      path.string())};
  return all;
}

key_ptr read_key(const std::filesystem::path& path) {
  check_secret(path);
  auto key = key_from_pem(read_pem(path));
  if (!key)
    throw network_error{
        fmt::format("{} is not a private key without a password: {}",
                    path.string(), remedy)};
  return key;
}

revocation_list read_revoked(const std::filesystem::path& path) {
  const auto content = read_regular_file(path, revocation_list::longest);
  if (content.error == ENOENT)
    return {};
  if (!content.refusal.empty())
    throw network_error{
        fmt::format("cannot read {}: {}; copy the one that `sofof keys revoke` "
                    "wrote",
                    path.string(), content.refusal)};
  return {content.text, path.string()};
}

const unsigned char* octets(std::span<const std::byte> bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

bool is_signed(std::span<const std::byte> bytes,
               std::span<const std::byte> signature, EVP_PKEY* key) {
  const digest_ptr digest{EVP_MD_CTX_new()};
  const auto fits =
      digest && key
      && EVP_DigestVerifyInit(digest.get(), nullptr, EVP_sha256(), nullptr, key)
             == 1
      && EVP_DigestVerifyUpdate(digest.get(), purpose.data(), purpose.size())
             == 1
      && EVP_DigestVerifyUpdate(digest.get(), bytes.data(), bytes.size()) == 1
      && EVP_DigestVerifyFinal(digest.get(), octets(signature),
                               signature.size())
             == 1;
  forget_openssl_errors();
  return fits;
}

} // namespace

credentials::credentials(const std::filesystem::path& folder)
    : parts_{load(folder)} {}

std::shared_ptr<const credentials::parts>
credentials::load(const std::filesystem::path& folder) {
  const auto ca_file = folder / "ca.pem";
  const auto certificate_file = folder / "cert.pem";
  const auto key_file = folder / "key.pem";
  const auto all = std::make_shared<parts>();
  const auto authorities = read_authorities(ca_file);
  all->authorities = authorities.size();
  all->trusted = store_of(authorities);
  all->certificate = read_certificate(certificate_file);
  all->key = read_key(key_file);
  all->revoked = read_revoked(folder / "revoked");
  if (X509_check_private_key(all->certificate.get(), all->key.get()) != 1) {
    forget_openssl_errors();
    throw network_error{fmt::format("{} is not the key of {}: take both from "
                                    "the same `sofof keys issue`",
                                    key_file.string(),
                                    certificate_file.string())};
  }
  // Whether it has been revoked is for others to say: a list with our own
  // certificate is still good for those of others.
  auto verdict = network::examine(*all->certificate, *all->trusted);
  if (!verdict.who)
    throw network_error{fmt::format("{} {} (the CA is {}): {}",
                                    certificate_file.string(), verdict.refusal,
                                    ca_file.string(), remedy)};
  all->who = std::move(*verdict.who);
  all->pem = to_pem(*all->certificate);
  return all;
}

certificate_verdict credentials::examine(X509& certificate) const {
  if (revoked().contains(certificate))
    return {{}, "has been revoked", X509_V_ERR_CERT_REVOKED};
  return network::examine(certificate, trusted());
}

std::vector<std::byte>
credentials::sign(std::span<const std::byte> bytes) const {
  if (bytes.size() > most_signed)
    throw network_error{fmt::format("{} bytes are too many to sign: at most {}",
                                    bytes.size(), most_signed)};
  const digest_ptr digest{EVP_MD_CTX_new()};
  std::vector<std::byte> signature(longest_signature);
  auto size = signature.size();
  require_openssl(
      digest
          && EVP_DigestSignInit(digest.get(), nullptr, EVP_sha256(), nullptr,
                                &key())
                 == 1
          && EVP_DigestSignUpdate(digest.get(), purpose.data(), purpose.size())
                 == 1
          && EVP_DigestSignUpdate(digest.get(), bytes.data(), bytes.size()) == 1
          && EVP_DigestSignFinal(
                 digest.get(),
                 reinterpret_cast<unsigned char*>(signature.data()), &size)
                 == 1,
      "signing");
  signature.resize(size);
  return signature;
}

proof credentials::prove(std::string_view certificate_pem,
                         std::span<const std::byte> bytes,
                         std::span<const std::byte> signature) const {
  if (certificate_pem.size() > largest_certificate || bytes.size() > most_signed
      || signature.size() > longest_signature)
    return {{}, "the proof is too long"};
  const auto certificate = certificate_from_pem(certificate_pem);
  if (!certificate)
    return {{}, "what was sent is not a certificate"};
  auto verdict = examine(*certificate);
  if (!verdict.who)
    return {{}, "the certificate " + verdict.refusal};
  if (!is_signed(bytes, signature, X509_get0_pubkey(certificate.get())))
    return {{},
            "the signature is not that of the certificate's key: "
                + describe(*verdict.who)};
  return {std::move(verdict.who), {}};
}

} // namespace sofof::network
