// A message of AMQP 1.0, as far as it is looked at here.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace sofof::network::amqp {

/// A value of an application property, of the type that it has on the wire.
using property = std::variant<bool, std::uint16_t, std::uint32_t, std::int64_t,
                              double, std::string, std::vector<std::byte>>;

using properties = std::map<std::string, property, std::less<>>;

/// A message with one binary body.
struct message {
  std::string user;    ///< Who says to have sent it (user-id); may be empty.
  std::string subject; ///< May be empty.
  properties all;      ///< Application properties.
  std::chrono::milliseconds created{}; ///< Since 1970, by its sender's clock.
  std::chrono::milliseconds ttl{};     ///< 0: it is never too old.
  std::vector<std::byte> body;

  friend bool operator==(const message&, const message&) = default;
};

/// @returns a property of this type; null when there is none.
template <class T>
const T* find(const properties& all, std::string_view name) {
  const auto at = all.find(name);
  return at == all.end() ? nullptr : std::get_if<T>(&at->second);
}

} // namespace sofof::network::amqp
