// Certificates: as text, whom they name, and whether our CA stands behind them.
#pragma once

#include "network/keys/identity.hpp"
#include "network/keys/openssl.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::network {

/// No certificate of ours is longer, as text; bytes.
inline constexpr std::size_t largest_certificate = 64 * 1024;

/// @returns the first certificate in a PEM text; null when there is none, and
/// for texts beyond `largest_certificate`.
x509_ptr certificate_from_pem(std::string_view pem);

/// @returns all certificates in a PEM text; none when one of them is broken,
/// and for texts beyond `largest_certificate`.
std::vector<x509_ptr> certificates_from_pem(std::string_view pem);

std::string to_pem(X509& certificate);

/// @returns the private key in a PEM text; null when there is none, when it is
/// encrypted, and for texts beyond `largest_certificate`.
key_ptr key_from_pem(std::string_view pem);

/// @returns a store that trusts these CAs only.
x509_store_ptr store_of(std::span<const x509_ptr> authorities);

/// @returns the serial number as `openssl x509 -serial` prints it: hexadecimal
/// digits, upper case.
std::string serial_of(const X509& certificate);

/// @returns whether its last second is over.
bool has_expired(const X509& certificate);

/// @returns its last second, since 1970.
std::int64_t last_second_of(const X509& certificate);

/// @returns e.g. "2026-11-22 10:00 UTC".
std::string end_of(const X509& certificate);

/// What a certificate is worth.
struct certificate_verdict {
  std::optional<peer_identity> who; ///< Nothing when it is refused.
  /// Why it is refused, as "has expired" goes on after "the certificate".
  std::string refusal;
  int error = 0; ///< The same as one of OpenSSL's X509_V_*; 0: accepted.
};

/// Which days a certificate is judged by.
enum class validity { now, ever };

/// Asks whether a certificate is signed by a trusted CA, is valid, names
/// stations or a provider, such as its CA may name, and is made for this:
/// stations open connections and providers answer them. Whatever it holds is no
/// danger.
certificate_verdict examine(X509& certificate, X509_STORE& trusted,
                            validity when = validity::now);

} // namespace sofof::network
