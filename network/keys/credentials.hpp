// What a process shows to others, and knows others by.
#pragma once

#include "network/keys/certificate.hpp"
#include "network/keys/identity.hpp"
#include "network/keys/openssl.hpp"
#include "network/keys/revocation_list.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::network {

/// Who has proved to be whom.
struct proof {
  std::optional<peer_identity> who; ///< Nothing when it is refused.
  std::string refusal;              ///< Why: a sentence without its full stop.
};

/// A certificate with its private key, the CAs that are trusted, and the
/// certificates that are not although they are theirs. Constant, hence good for
/// any number of threads; a copy shares them.
class credentials {
public:
  /// More is never signed nor checked; bytes.
  static constexpr std::size_t most_signed = 64 * 1024;
  static constexpr std::size_t longest_signature = 1024;

  /// Loads `ca.pem`, which may hold several CAs, `cert.pem`, `key.pem`, and
  /// `revoked` if it is there, as `issue_keys` writes them.
  /// @throws network_error when one is missing, unreadable or not what its
  /// name says, when others may read or change the key, when it does not fit,
  /// and when the certificate is not signed by one of these CAs, is not valid
  /// now, or names no station or provider.
  explicit credentials(const std::filesystem::path& folder);

  /// @returns whom our certificate names.
  const peer_identity& identity() const { return parts_->who; }
  const std::string& certificate_pem() const { return parts_->pem; }

  /// @param bytes  At most `most_signed` of them.
  /// @returns a signature with our key, good for `prove` and nothing else.
  /// @throws network_error for more bytes.
  std::vector<std::byte> sign(std::span<const std::byte> bytes) const;

  /// Asks whether whoever sent these holds the key of a certificate that
  /// `examine` accepts, and has signed these bytes.
  /// Anything may come from a peer: this never throws for it.
  proof prove(std::string_view certificate_pem,
              std::span<const std::byte> bytes,
              std::span<const std::byte> signature) const;

  /// Asks whether a peer's certificate is good now
  /// (network/keys/certificate.hpp) and has not been revoked.
  certificate_verdict examine(X509& certificate) const;

  const revocation_list& revoked() const { return parts_->revoked; }

  /// @returns how many CAs are trusted.
  std::size_t authorities() const { return parts_->authorities; }

  /// For TLS; they stay ours.
  X509& certificate() const { return *parts_->certificate; }
  EVP_PKEY& key() const { return *parts_->key; }
  X509_STORE& trusted() const { return *parts_->trusted; }

private:
  struct parts {
    x509_ptr certificate;
    key_ptr key;
    x509_store_ptr trusted;
    std::size_t authorities = 0;
    revocation_list revoked;
    std::string pem;
    peer_identity who;
  };

  static std::shared_ptr<const parts> load(const std::filesystem::path& folder);

  std::shared_ptr<const parts> parts_;
};

} // namespace sofof::network
