// Who may look on.
#pragma once

#include "network/http/message.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace sofof::live {

/// On addresses of this machine alone everybody on it may look on, and nobody
/// whose browser was sent here by a page of somebody else's name. On others
/// whoever has the token may.
class gate {
public:
  /// @param host  The address at which is listened, as a number.
  /// @throws network::network_error without a source of randomness.
  explicit gate(std::string_view host);

  /// @returns what comes behind the address of a page: "?token=..." or nothing.
  const std::string& query() const { return query_; }

  /// @returns nullopt for who may; else what to tell.
  std::optional<network::http::response>
  refuse(const network::http::request& x) const;

private:
  std::string query_; ///< Empty: none is needed.
};

/// @returns whether an address, or "localhost", is of this machine alone.
bool is_loopback(std::string_view host);

} // namespace sofof::live
