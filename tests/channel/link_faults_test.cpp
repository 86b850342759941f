// Faults for tests: messages that get lost, come twice, or out of order.
#include "channel/link_faults.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::channel;
using test::near;
using namespace std::chrono_literals;

namespace {

constexpr auto sent = 100'000;

} // namespace

TEST_CASE("nothing goes wrong unless asked for") {
  const link_faults faults{random_stream{1, "faults"}, {}};
  for (auto n = 0; n < 1000; ++n) {
    const auto fate = faults.of(n);
    CHECK(!fate.lost);
    CHECK(!fate.copy_after);
    CHECK(fate.extra_delay == 0ns);
  }
}

TEST_CASE("faults are as frequent as asked for, and bounded") {
  const link_faults faults{random_stream{1, "faults"},
                           {.loss = 0.2,
                            .duplicate = 0.1,
                            .reorder = 0.3,
                            .longest_extra_delay = 40ms}};
  auto lost = 0;
  auto copied = 0;
  auto delayed = 0;
  auto both = 0;
  for (auto n = 0; n < sent; ++n) {
    const auto fate = faults.of(n);
    lost += fate.lost;
    copied += fate.copy_after.has_value();
    delayed += fate.extra_delay > 0ns;
    both += fate.copy_after && fate.extra_delay > 0ns;
    REQUIRE(fate.extra_delay <= 40ms);
    REQUIRE(fate.copy_after.value_or(0ns) <= 40ms);
  }
  CHECK(lost / double{sent} == near(0.2, 0.05));
  // Of those that are not lost.
  CHECK(copied / (0.8 * sent) == near(0.1, 0.05));
  CHECK(delayed / (0.8 * sent) == near(0.3, 0.05));
  CHECK(both / (0.8 * sent) == near(0.03, 0.1));
}

TEST_CASE("one kind of fault does not shift another") {
  const random_stream s{1, "faults"};
  const link_faults few{s, {.loss = 0.1}};
  const link_faults many{s, {.loss = 0.1, .duplicate = 1, .reorder = 1}};
  for (auto n = 0; n < 1000; ++n)
    CHECK(few.of(n).lost == many.of(n).lost);
}
