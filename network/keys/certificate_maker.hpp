// How keys and certificates are made.
#pragma once

#include "network/keys/identity.hpp"
#include "network/keys/openssl.hpp"

#include <string>
#include <vector>

namespace sofof::network {

/// A certificate may be valid this long, days; a CA is.
inline constexpr int longest_validity_days = 3650;

/// Whom a CA may name, beside nobody else; all if there are none of both.
struct permitted_names {
  std::vector<station_id> stations; ///< Each once, in order.
  std::vector<std::string> providers;
};

/// @returns a private key, of the curve P-256.
key_ptr make_key();

/// @returns the key as text, PKCS #8 without a password.
std::string to_pem(EVP_PKEY& key);

/// @returns a certificate that signs itself, and others that name whom it may
/// name and neither hosts nor mailboxes.
x509_ptr make_authority(EVP_PKEY& key, const permitted_names& names);

/// @returns a certificate of the CA for this identity.
x509_ptr make_certificate(EVP_PKEY& key, const peer_identity& who, int days,
                          X509& ca, EVP_PKEY& ca_key);

} // namespace sofof::network
