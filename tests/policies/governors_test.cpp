// Tests of what keeps a scorer in check: gate and hysteresis.
#include "policies/algorithms/forecast/predictive_gate.hpp"
#include "policies/algorithms/switching/hysteresis.hpp"
#include "tests/support/at.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <optional>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;
using test::at;
using test::dice;
using test::on_board;

namespace {

constexpr provider_id near_one = 7;
constexpr provider_id far_one = 8;

} // namespace

TEST_CASE("a gate opens at its lower and closes above its upper threshold") {
  predictive_gate gate{0.005, 0.02};
  CHECK(!gate.open());
  CHECK(!gate.update(0.01));
  CHECK(gate.update(0.005));
  CHECK(gate.update(0.01));
  CHECK(gate.update(0.02));
  CHECK(!gate.update(0.021));
  CHECK(!gate.update(0.01));
}

TEST_CASE("a gate closes when its forecast is no number, and stays so") {
  predictive_gate gate{0.5, 1};
  CHECK(gate.update(0));
  CHECK(!gate.update(std::numeric_limits<double>::quiet_NaN()));
  CHECK(!gate.open());
}

TEST_CASE("a better source is followed once it has been better for the time "
          "to trigger") {
  hysteresis governor;
  CHECK(governor.next({near_one, 0.1}, at(0s)) == on_board);
  CHECK(governor.next({near_one, 0.1}, at(499ms)) == on_board);
  CHECK(governor.next({near_one, 0.1}, at(500ms)) == near_one);
}

TEST_CASE("an advantage of the margin or of no number is none") {
  hysteresis governor;
  for (int k = 0; k < 100; ++k) {
    governor.next({near_one, 0.05}, at(k * 100ms));
    governor.next({near_one, std::numeric_limits<double>::quiet_NaN()},
                  at(k * 100ms));
  }
  CHECK(governor.source() == on_board);
}

TEST_CASE("a break, or another challenger, starts the time to trigger anew") {
  hysteresis governor;
  governor.next({near_one, 0.1}, at(0s));
  governor.next({near_one, 0.01}, at(400ms));
  governor.next({near_one, 0.1}, at(450ms));
  CHECK(governor.next({near_one, 0.1}, at(900ms)) == on_board);
  governor.next({far_one, 0.1}, at(940ms));
  CHECK(governor.next({near_one, 0.1}, at(960ms)) == on_board);
  CHECK(governor.next({near_one, 0.1}, at(1460ms)) == near_one);
}

TEST_CASE("between two switches lies the dwell, however good the other is") {
  hysteresis governor;
  governor.next({near_one, 9}, at(0s));
  CHECK(governor.next({near_one, 9}, at(500ms)) == near_one);
  governor.next({far_one, 9}, at(600ms));
  CHECK(governor.next({far_one, 9}, at(2499ms)) == near_one);
  CHECK(governor.next({far_one, 9}, at(2500ms)) == far_one);
}

TEST_CASE("after a fallback the dwell passes before anybody is asked again") {
  hysteresis governor;
  governor.next({near_one, 1}, at(0s));
  CHECK(governor.next({near_one, 1}, at(1s)) == near_one);
  CHECK(governor.next({near_one, 1, true}, at(1001ms)) == on_board);
  duration back{0};
  for (auto t = 1010ms; back == 0s && t < 10s; t += 10ms)
    if (governor.next({near_one, 1}, at(t)) == near_one)
      back = t;
  CHECK(back == 3010ms);
}

TEST_CASE("a fallback of who is local already is no switch") {
  hysteresis governor;
  CHECK(governor.next({near_one, 1, true}, at(0s)) == on_board);
  governor.next({near_one, 1}, at(100ms));
  CHECK(governor.next({near_one, 1}, at(600ms)) == near_one);
}

TEST_CASE("no fallback is delayed, and no two other switches come closer than "
          "the dwell") {
  dice random{3};
  for (int drive = 0; drive < 200; ++drive) {
    hysteresis governor;
    std::optional<time_point> switched;
    auto now = at(0s);
    for (int k = 0; k < 500; ++k) {
      now += from_seconds(random.between(0, 0.2));
      const auto id = static_cast<provider_id>(random.between(0, 1.2) * 2);
      const auto source = id == 0 ? on_board : service_place{id};
      const auto falls_back = random.between(0, 1) < 0.02;
      const auto before = governor.source();
      const auto after =
          governor.next({source, random.between(0.04, 1), falls_back}, now);
      if (falls_back)
        REQUIRE(after == on_board);
      if (after == before)
        continue;
      if (!falls_back && switched)
        REQUIRE(now - *switched >= 2s);
      switched = now;
    }
  }
}
