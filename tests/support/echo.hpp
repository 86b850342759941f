// The smallest result there is, for tests of the framework.
#pragma once

#include "messages/protocol/payload.hpp"

#include <cstdint>

namespace sofof::test {

/// Whatever the client said last.
struct echo {
  std::uint64_t number = 0;

  /// What continues nothing; no vehicle counts as far.
  static constexpr std::uint64_t jump = ~std::uint64_t{0};
  /// What no vehicle believes.
  static constexpr std::uint64_t lie = jump - 1;
  /// What is of no use, and perhaps no lie.
  static constexpr std::uint64_t useless = jump - 2;
};

void visit_fields(auto& v, echo& x) {
  v("number", x.number);
}

} // namespace sofof::test

template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::test::echo> = "echo";
