// Which messages are too old, whatever the sender's clock says.
#include "network/flow/freshness.hpp"

#include "tests/support/at.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace std::chrono_literals;
using network::freshness;
using test::at;

TEST_CASE("a message is as old as it is slower than the fastest one of late") {
  for (const duration clock_gap : {0s, 3600s, -3600s}) {
    freshness all{10};
    CHECK(all.is_fresh(101, clock_gap + 5ms, 100ms, at(1s)));
    CHECK(all.is_fresh(101, clock_gap + 104ms, 100ms, at(2s)));
    CHECK_FALSE(all.is_fresh(101, clock_gap + 106ms, 100ms, at(3s)));
    CHECK(all.is_fresh(101, clock_gap + 106ms, 1s, at(3s)));
    CHECK(all.is_fresh(102, clock_gap + 106ms, 100ms, at(3s)));
  }
}

TEST_CASE("clocks that drift apart make no message old") {
  freshness all{10};
  for (auto t = 0s; t < 3600s; t += 1s) // 50 ppm
    CHECK(all.is_fresh(101, t / 20'000, 20ms, at(t)));
}

TEST_CASE("of many senders all are forgotten, and nothing is lost by that") {
  freshness all{2};
  for (std::uint64_t sender = 0; sender < 100; ++sender)
    CHECK(all.is_fresh(sender, 5ms, 1ms, at(1s)));
}
