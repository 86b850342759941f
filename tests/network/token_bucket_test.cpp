// Tests of how much a peer may have in a while.
#include "network/flow/token_bucket.hpp"

#include "tests/support/at.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/not_a_number.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

using namespace sofof;
using namespace sofof::network;
using namespace std::chrono_literals;
using test::at;
using test::dice;
using test::not_a_number;

namespace {

constexpr auto infinity = std::numeric_limits<double>::infinity();

} // namespace

TEST_CASE("a burst is granted at once, and no more") {
  token_bucket limit{10, 3};
  for (int k = 0; k < 3; ++k)
    CHECK(limit.try_spend(at(0s)));
  CHECK(!limit.try_spend(at(0s)));
}

TEST_CASE("tokens come back at the rate, up to the burst") {
  token_bucket limit{8, 2};
  CHECK(limit.try_spend(at(0s), 2));
  CHECK(!limit.try_spend(at(124ms)));
  CHECK(limit.try_spend(at(125ms)));
  CHECK(!limit.try_spend(at(125ms)));
  CHECK(!limit.try_spend(at(1h), 3));
  CHECK(limit.try_spend(at(1h), 2));
}

TEST_CASE("who asks for too much leaves the tokens to others") {
  token_bucket limit{1, 5};
  CHECK(!limit.try_spend(at(0s), 6));
  CHECK(limit.try_spend(at(0s), 5));
}

TEST_CASE("what is no number of tokens is never granted") {
  token_bucket limit{1, 5};
  CHECK(!limit.try_spend(at(0s), -1));
  CHECK(!limit.try_spend(at(0s), not_a_number));
  CHECK(!limit.try_spend(at(0s), infinity));
  CHECK(limit.try_spend(at(0s), 5));
  CHECK(!limit.try_spend(at(0s)));
}

TEST_CASE("time that goes backwards brings no tokens and takes none") {
  token_bucket limit{10, 2};
  CHECK(limit.try_spend(at(10s)));
  CHECK(limit.try_spend(at(1s)));
  CHECK(!limit.try_spend(at(2s)));
  CHECK(!limit.try_spend(at(10s)));
  CHECK(limit.try_spend(at(10s + 100ms)));
}

TEST_CASE("the ends of time do no harm") {
  token_bucket limit{10, 1};
  CHECK(limit.try_spend(time_point::min()));
  CHECK(!limit.try_spend(time_point::min()));
  CHECK(limit.try_spend(time_point::max()));
  CHECK(!limit.try_spend(time_point::min()));
  CHECK(!limit.try_spend(time_point::max()));
}

TEST_CASE("whatever is asked when, no more than the burst and the rate times "
          "the time is granted") {
  dice random{3};
  for (int series = 0; series < 200; ++series) {
    const auto per_second = random.between(0, 50);
    const auto burst = random.between(0, 20);
    token_bucket limit{per_second, burst};
    duration now{0};
    duration latest{0};
    double granted = 0;
    limit.try_spend(at(now), 0);
    for (int k = 0; k < 500; ++k) {
      now += from_seconds(random.between(-0.05, 0.1));
      latest = std::max(latest, now);
      const auto n = random.between(0, 5);
      granted += limit.try_spend(at(now), n) ? n : 0;
      REQUIRE(granted <= burst + per_second * to_seconds(latest) + 1e-6);
    }
  }
}

TEST_CASE("who keeps to the rate is never refused") {
  token_bucket limit{20, 2};
  for (int k = 0; k < 10'000; ++k)
    REQUIRE(limit.try_spend(at(k * 50ms)));
}
