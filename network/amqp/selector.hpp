// Which messages a receiver wants: selectors as JMS has them.
#pragma once

#include "network/amqp/message.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace sofof::network::amqp {

/// A condition on the properties of a message, e.g.
/// "NOT(station_id = 101) AND mid = 2049". It knows AND, OR, NOT, brackets,
/// the comparisons =, <>, <, <=, >, >=, and LIKE, IN, BETWEEN and IS NULL, each
/// also with NOT; numbers, texts in single quotes, TRUE and FALSE. There is no
/// arithmetic. Source: Jakarta Messaging 3.1, section 3.8.1.
class selector {
public:
  /// Selects everything.
  selector();
  /// @throws network_error when it cannot be read: what is wrong, and where.
  explicit selector(std::string_view text);
  ~selector();
  selector(selector&&) noexcept;
  selector& operator=(selector&&) noexcept;

  /// @returns whether the condition is true; it is neither true nor false where
  /// a property is missing, or of another type.
  bool matches(const properties& of) const;

  /// More characters, deeper brackets and more operands are refused, and a
  /// longer text is like nothing and unlike nothing.
  static constexpr std::size_t longest = 4096;
  static constexpr int deepest = 64;
  static constexpr int most_operands = 256;
  static constexpr std::size_t longest_text = 256;

  struct node; ///< Of the tree that it is.

private:
  std::unique_ptr<const node> root_;
};

} // namespace sofof::network::amqp
