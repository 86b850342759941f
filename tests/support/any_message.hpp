// A message of any kind that is known.
#pragma once

#include "messages/etsi/message.hpp"
#include "tests/support/random_pdu.hpp"

#include <cstdint>
#include <utility>
#include <variant>

namespace sofof::test {

/// @returns a message of random content; one kind after the other by its seed.
inline messages::etsi::message any_message(std::uint64_t seed,
                                           random_pdu::mix m = {}) {
  random_pdu random{seed, m};
  messages::etsi::message any;
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    const auto make = [&]<std::size_t n>() {
      using kind = std::variant_alternative_t<n, messages::etsi::message>;
      if (seed % sizeof...(i) == n)
        any = random.message<kind>();
    };
    (make.template operator()<i>(), ...);
  }
  (std::make_index_sequence<std::variant_size_v<messages::etsi::message>>{});
  return any;
}

} // namespace sofof::test
