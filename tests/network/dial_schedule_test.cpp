// Tests of when a peer is called that may not answer, or may hang up.
#include "network/flow/dial_schedule.hpp"

#include "tests/support/at.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::network;
using namespace std::chrono_literals;
using test::at;

namespace {

/// Whose first pause has begun at 10 s: there is none before it.
dial_schedule begun() {
  dial_schedule calls{random_stream{1, "calls"}, 2s};
  calls.pause(at(10s));
  return calls;
}

} // namespace

TEST_CASE("a peer is called at once at first") {
  CHECK(begun().is_due(at(10s)));
}

TEST_CASE("no second attempt begins beside one that is not over") {
  auto calls = begun();
  calls.begin(at(10s));
  CHECK_FALSE(calls.is_due(at(12s)));
  calls.end();
  CHECK(calls.is_due(at(12s)));
}

TEST_CASE("an attempt that hangs is not waited for without end") {
  auto calls = begun();
  calls.begin(at(10s));
  CHECK_FALSE(calls.is_due(at(12s)));
  CHECK(calls.is_due(at(12s + 1ns)));
}

TEST_CASE("the pause before the next attempt begins with the one before it") {
  auto calls = begun();
  calls.begin(at(10s));
  calls.end();
  CHECK_FALSE(calls.is_due(at(10s + 49ms)));
  CHECK(calls.is_due(at(10s + 100ms)));
}

TEST_CASE("pauses grow to a second, until the peer proves itself") {
  auto calls = begun();
  auto now = 10s + 0ms;
  for (int k = 0; k < 10; ++k) {
    calls.begin(at(now));
    calls.end();
    now += 1s;
  }
  calls.pause(at(now));
  CHECK_FALSE(calls.is_due(at(now + 499ms)));
  CHECK(calls.is_due(at(now + 1s)));
  calls.succeeded();
  calls.pause(at(now));
  CHECK(calls.is_due(at(now)));
}
