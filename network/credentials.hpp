// What a process shows to others, and knows others by.
#pragma once

#include "network/certificate.hpp"
#include "network/identity.hpp"
#include "network/openssl.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// Who has proved to be whom.
struct proof {
  std::optional<peer_identity> who; ///< Nothing when it is refused.
  std::string refusal;              ///< Why: a sentence without its full stop.
};

/// A certificate with its private key, and the CA that is trusted. Constant,
/// hence good for any number of threads.
class credentials {
public:
  /// More is never signed nor checked; bytes.
  static constexpr std::size_t most_signed = 64 * 1024;
  static constexpr std::size_t longest_signature = 1024;

  /// Loads `ca.pem`, `cert.pem` and `key.pem`, as `issue_keys` writes them.
  /// @throws network_error when one is missing, unreadable or not what its
  /// name says, when the key does not fit, and when the certificate is not
  /// signed by this CA, is not valid now, or names no station or provider.
  explicit credentials(const std::filesystem::path& folder);

  /// @returns whom our certificate names.
  const peer_identity& identity() const { return who_; }
  const std::string& certificate_pem() const { return pem_; }

  /// @param bytes  At most `most_signed` of them.
  /// @returns a signature with our key, good for `prove` and nothing else.
  /// @throws network_error for more bytes.
  std::vector<std::byte> sign(std::span<const std::byte> bytes) const;

  /// Asks whether whoever sent these holds the key of a certificate of our CA:
  /// signed by it, valid now, made for what it names, and these bytes signed.
  /// Anything may come from a peer: this never throws for it.
  proof prove(std::string_view certificate_pem,
              std::span<const std::byte> bytes,
              std::span<const std::byte> signature) const;

  /// For TLS; they stay ours.
  X509& certificate() const { return *certificate_; }
  EVP_PKEY& key() const { return *key_; }
  X509_STORE& trusted() const { return *trusted_; }

private:
  x509_ptr certificate_;
  key_ptr key_;
  x509_store_ptr trusted_;
  std::string pem_;
  peer_identity who_;
};

} // namespace sofof
