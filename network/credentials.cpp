// Loading credentials, signing, and checking signatures of others.
#include "network/credentials.hpp"

#include "network/network_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <openssl/evp.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <system_error>

namespace sofof {

namespace {

/// Goes before whatever is signed, so that a signature is of no use elsewhere.
constexpr std::string_view purpose = "sofof proof 1\n";

constexpr auto remedy = "`sofof keys issue` makes it anew";

struct file_closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string read_pem(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, file_closer> file{
      std::fopen(path.c_str(), "rb")};
  std::string text(largest_certificate + 1, '\0');
  if (file)
    text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  if (!file || std::ferror(file.get()))
    throw network_error{
        fmt::format("cannot read {}: {}; {} in a folder that you can read",
                    path.string(), std::generic_category().message(errno),
                    errno == ENOENT ? "`sofof keys issue` makes it" : remedy)};
  if (text.size() > largest_certificate)
    throw network_error{
        fmt::format("{} is too long to be right: {}", path.string(), remedy)};
  return text;
}

x509_ptr read_certificate(const std::filesystem::path& path) {
  auto certificate = certificate_from_pem(read_pem(path));
  if (!certificate)
    throw network_error{
        fmt::format("{} is not a certificate: {}", path.string(), remedy)};
  return certificate;
}

key_ptr read_key(const std::filesystem::path& path) {
  auto key = key_from_pem(read_pem(path));
  if (!key)
    throw network_error{
        fmt::format("{} is not a private key without a password: {}",
                    path.string(), remedy)};
  return key;
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

credentials::credentials(const std::filesystem::path& folder) {
  const auto ca_file = folder / "ca.pem";
  const auto certificate_file = folder / "cert.pem";
  const auto key_file = folder / "key.pem";
  const auto ca = read_certificate(ca_file);
  if (X509_check_ca(ca.get()) != 1)
    throw network_error{
        fmt::format("{} is not the certificate of a CA: copy the one that "
                    "`sofof keys init` wrote",
                    ca_file.string())};
  certificate_ = read_certificate(certificate_file);
  key_ = read_key(key_file);
  trusted_ = store_of(*ca);
  if (X509_check_private_key(certificate_.get(), key_.get()) != 1) {
    forget_openssl_errors();
    throw network_error{fmt::format("{} is not the key of {}: take both from "
                                    "the same `sofof keys issue`",
                                    key_file.string(),
                                    certificate_file.string())};
  }
  auto verdict = examine(*certificate_, *trusted_);
  if (!verdict.who)
    throw network_error{fmt::format("{} {} (the CA is {}): {}",
                                    certificate_file.string(), verdict.refusal,
                                    ca_file.string(), remedy)};
  who_ = std::move(*verdict.who);
  pem_ = to_pem(*certificate_);
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
                                key_.get())
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
  auto verdict = examine(*certificate, *trusted_);
  if (!verdict.who)
    return {{}, "the certificate " + verdict.refusal};
  if (!is_signed(bytes, signature, X509_get0_pubkey(certificate.get())))
    return {{},
            "the signature is not that of the certificate's key: "
                + describe(*verdict.who)};
  return {std::move(verdict.who), {}};
}

} // namespace sofof
