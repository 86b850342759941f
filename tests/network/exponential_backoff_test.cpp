// Tests of when to try again.
#include "network/flow/exponential_backoff.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace sofof;
using namespace sofof::network;
using namespace std::chrono_literals;
using test::dice;

TEST_CASE("the first attempt starts at once") {
  for (const auto draw : {0.0, 0.5, std::nextafter(1.0, 0.0)}) {
    exponential_backoff attempts;
    CHECK(attempts.next_wait(draw) == 0ns);
  }
}

TEST_CASE("waits double from 100 ms to 1 s") {
  exponential_backoff attempts;
  for (const auto wait : {0ms, 100ms, 200ms, 400ms, 800ms, 1000ms, 1000ms})
    CHECK(attempts.next_wait(0) == wait);
}

TEST_CASE("after a success the next attempt starts at once, and waits grow "
          "anew") {
  exponential_backoff attempts;
  for (int k = 0; k < 10; ++k)
    attempts.next_wait(0);
  attempts.succeeded();
  CHECK(attempts.next_wait(0) == 0ns);
  CHECK(attempts.next_wait(0) == 100ms);
}

TEST_CASE("no wait is longer than 1 s or shorter than half its period") {
  dice random{5};
  for (int series = 0; series < 1000; ++series) {
    exponential_backoff attempts;
    attempts.next_wait(random.between(0, 1));
    duration period = 100ms;
    for (int k = 0; k < 20; ++k) {
      const auto wait = attempts.next_wait(random.between(0, 1));
      CHECK(wait <= period);
      CHECK(wait >= period / 2);
      CHECK(wait <= 1s);
      period = std::min<duration>(2 * period, 1s);
    }
  }
}

TEST_CASE("peers that failed together do not come back together") {
  dice random{6};
  exponential_backoff attempts;
  for (int k = 0; k < 5; ++k)
    attempts.next_wait(0);
  auto least = duration::max();
  auto most = duration::min();
  for (int k = 0; k < 100; ++k) {
    const auto wait = attempts.next_wait(random.between(0, 1));
    least = std::min(least, wait);
    most = std::max(most, wait);
  }
  CHECK(least < 550ms);
  CHECK(most > 950ms);
}
