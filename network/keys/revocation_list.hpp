// Certificates that nobody shall believe any more.
#pragma once

#include "network/keys/openssl.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::network {

/// Serial numbers of certificates; constant once it is read.
class revocation_list {
public:
  /// A longer file is none; bytes.
  static constexpr std::size_t longest = 1024 * 1024;

  revocation_list() = default;

  /// @param text  A serial number a line, as `openssl x509 -serial` prints it
  ///              or with ':' between the octets. What follows a '#' is a
  ///              comment.
  /// @param file  What to call it.
  /// @throws network_error with file and line for anything else.
  revocation_list(std::string_view text, std::string_view file);

  bool contains(const X509& certificate) const;
  /// @param serial  As `parse_serial` gives it.
  bool contains(const std::string& serial) const;
  std::size_t size() const { return serials_.size(); }

private:
  std::vector<std::string> serials_; // each once, in order
};

/// @returns a serial number in upper case, without ':' and zeros in front;
/// empty for what is none.
std::string parse_serial(std::string_view text);

} // namespace sofof::network
