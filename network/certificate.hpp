// Certificates: as text, whom they name, and whether our CA stands behind them.
#pragma once

#include "network/identity.hpp"
#include "network/openssl.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sofof {

/// No certificate of ours is longer, as text; bytes.
inline constexpr std::size_t largest_certificate = 64 * 1024;

/// @returns the first certificate in a PEM text; null when there is none, and
/// for texts beyond `largest_certificate`.
x509_ptr certificate_from_pem(std::string_view pem);

std::string to_pem(X509& certificate);

/// @returns the private key in a PEM text; null when there is none, when it is
/// encrypted, and for texts beyond `largest_certificate`.
key_ptr key_from_pem(std::string_view pem);

/// @returns a store that trusts this CA only.
x509_store_ptr store_of(X509& ca);

/// What a certificate is worth.
struct certificate_verdict {
  std::optional<peer_identity> who; ///< Nothing when it is refused.
  /// Why it is refused, as "has expired" goes on after "the certificate".
  std::string refusal;
  int error = 0; ///< The same as one of OpenSSL's X509_V_*; 0: accepted.
};

/// Asks whether a certificate is signed by the trusted CA, is valid now, names
/// stations or a provider, and is made for this: stations open connections and
/// providers answer them. Whatever it holds is no danger.
certificate_verdict examine(X509& certificate, X509_STORE& trusted);

} // namespace sofof
