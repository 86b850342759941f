// A private CA in a folder, and the certificates that it gives.
#pragma once

#include "network/keys/certificate_maker.hpp"
#include "network/keys/identity.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sofof::network {

struct issue_options {
  int days = 825; ///< How long it is valid; 1 to `longest_validity_days`.
  /// The folder to write; otherwise one in the CA's folder, named after the
  /// identity.
  std::optional<std::filesystem::path> out;
};

/// Makes a private CA: `ca.pem`, and `ca_key.pem` for its owner only.
/// @param folder  Made with its parents where missing.
/// @param names   Whom it may name.
/// @throws network_error when it cannot be written, and when there is one.
void init_keys(const std::filesystem::path& folder,
               const permitted_names& names = {});

/// Makes a key and a certificate of the CA for a peer: `ca.pem`, `cert.pem`,
/// `revoked` if the CA has one and, for its owner only, `key.pem`, all of them
/// or none. The CA's `issued` gets a line.
/// @param folder  Of the CA, whose `ca.pem` may hold others that are trusted as
///                well.
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

/// Makes another key and certificate for the same peer, in the place of those
/// in a folder, at once.
/// @param of    The folder, with a certificate of this CA, or of one that is
///              trusted in its folder; it may have expired.
/// @param days  How long it is valid; 1 to `longest_validity_days`.
/// @returns whom it names.
/// @throws network_error as `issue_keys`, and for a certificate that was
/// revoked.
peer_identity renew_keys(const std::filesystem::path& folder,
                         const std::filesystem::path& of,
                         int days = issue_options{}.days);

/// Certificates to take back.
struct revocation_choice {
  peer_identity who;  ///< All that speak for one of these.
  std::string serial; ///< Or this one.
};

/// Adds certificates to the CA's list `revoked`, which its peers' hosts need.
/// @returns those that were not in it yet, for people.
/// @throws network_error when the folder holds no CA, when nothing was issued
/// to these, for what is no serial number, and when it cannot be written.
std::vector<std::string> revoke_keys(const std::filesystem::path& folder,
                                     const revocation_choice& which);

} // namespace sofof::network
