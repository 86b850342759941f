// What encoding takes from the heap: nothing.
#include "messages/etsi/cam.hpp"
#include "messages/etsi/cpm_tr103562.hpp"
#include "messages/etsi/cpm_ts103324.hpp"
#include "messages/etsi/mcm.hpp"
#include "messages/etsi/uper.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/random_pdu.hpp"

#include <doctest/doctest.h>

#include <array>
#include <vector>

using namespace sofof;
using namespace sofof::messages;

namespace {

template <class Message>
void check_that_encoding_takes_no_heap() {
  static std::array<std::byte, 1 << 16> room;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    test::random_pdu random{seed, {.presence = 0.8, .longest = 20}};
    const auto message = random.message<Message>();
    const auto before = test::allocations;
    const auto octets = etsi::encode(message, std::span<std::byte>{room});
    const auto after = test::allocations;
    REQUIRE(octets > 0);
    REQUIRE(after == before);
  }
}

} // namespace

TEST_CASE("encoding takes nothing from the heap") {
  const auto before = test::allocations;
  static std::vector<int> some;
  some.reserve(1);
  REQUIRE(test::allocations > before); // it is really counted
  check_that_encoding_takes_no_heap<etsi::cam>();
  check_that_encoding_takes_no_heap<etsi::tr103562::cpm>();
  check_that_encoding_takes_no_heap<etsi::ts103324::cpm>();
  check_that_encoding_takes_no_heap<etsi::mcm>();
}
