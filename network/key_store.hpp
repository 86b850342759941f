// A private CA in a folder, and the certificates that it gives.
#pragma once

#include "network/identity.hpp"

#include <filesystem>
#include <optional>

namespace sofof {

/// A certificate may be valid this long, days; a CA is.
inline constexpr int longest_validity_days = 3650;

struct issue_options {
  int days = 825; ///< How long it is valid; 1 to `longest_validity_days`.
  /// The folder to write; otherwise one in the CA's folder, named after the
  /// identity.
  std::optional<std::filesystem::path> out;
};

/// Makes a private CA: `ca.pem`, and `ca_key.pem` for its owner only.
/// @param folder  Made with its parents where missing.
/// @throws network_error when it cannot be written, and when there is one.
void init_keys(const std::filesystem::path& folder);

/// Makes a key and a certificate of the CA for a peer: `ca.pem`, `cert.pem`
/// and, for its owner only, `key.pem`, all of them or none.
/// @param folder  Of the CA.
/// @param who     Stations, which open connections, or a provider, which
///                answers them.
/// @returns the folder written; by default `folder`/station-101-106 or
/// `folder`/provider-mec.
/// @throws network_error when the folder holds no CA, when the CA ends
/// sooner, when the identity or the days cannot be, when it cannot be written,
/// and when the folder to write is there.
std::filesystem::path issue_keys(const std::filesystem::path& folder,
                                 const peer_identity& who,
                                 const issue_options& options = {});

} // namespace sofof
