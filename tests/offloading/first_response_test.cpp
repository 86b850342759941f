// Tests of redundancy: the first response wins, plans join.
#include "offloading/first_response.hpp"

#include "policies/algorithms/forecast/continuity.hpp"
#include "tests/support/at.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/joint_miss_probability.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <set>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;
using test::at;
using test::dice;

namespace {

// Straight ahead at 10 m/s, a point every 100 ms, so far to the left.
std::vector<point> plan(int points, double left_m) {
  std::vector<point> positions;
  for (int k = 0; k < points; ++k)
    positions.push_back({1.0 * k, left_m});
  return positions;
}

} // namespace

TEST_CASE("of each cycle the first response is used, later ones are dropped "
          "and counted") {
  offloading::first_response responses{100ms};
  CHECK(responses.use(at(0ms)));
  CHECK(!responses.use(at(0ms)));
  CHECK(responses.use(at(100ms)));
  CHECK(responses.use(at(300ms)));
  CHECK(!responses.use(at(200ms)));
  CHECK(!responses.use(at(300ms)));
  CHECK(responses.dropped() == 3);
}

TEST_CASE("what begins half a period after a cycle is of the next one") {
  offloading::first_response responses{100ms};
  CHECK(responses.use(at(1s)));
  CHECK(!responses.use(at(1049ms)));
  CHECK(responses.use(at(1050ms)));
  CHECK(!responses.use(at(1099ms)));
  CHECK(responses.use(at(1100ms)));
}

TEST_CASE("no cycle is used twice, in whatever order responses come, and "
          "however far providers are out of step") {
  dice random{5};
  offloading::first_response responses{100ms};
  std::set<long> used;
  std::uint64_t heard = 0;
  for (int k = 0; k < 5000; ++k) {
    const auto cycle = static_cast<long>(k / 3 + random.between(0, 9));
    const auto step = from_seconds(0.001 * random.between(-24, 24));
    ++heard;
    if (responses.use(at(1s) + cycle * 100ms + step))
      REQUIRE(used.insert(cycle).second);
  }
  CHECK(used.size() + responses.dropped() == heard);
}

TEST_CASE("a hedge is due after h, unless an answer is there") {
  offloading::first_response responses{100ms};
  CHECK(!responses.hedge_due(at(1s), at(1019ms), 20ms));
  CHECK(responses.hedge_due(at(1s), at(1020ms), 20ms));
  responses.use(at(1s));
  CHECK(!responses.hedge_due(at(1s), at(1020ms), 20ms));
  CHECK(responses.hedge_due(at(1100ms), at(1120ms), 20ms));
}

TEST_CASE("all providers miss a cycle with the product of their chances") {
  CHECK(joint_miss_probability(std::array{0.5, 0.25}) == 0.125);
  CHECK(joint_miss_probability({}) == 1);
}

TEST_CASE("plans within 0.3 m for half a second may follow each other") {
  CHECK(continues(plan(6, 0), plan(6, 0.3), 100ms));
  CHECK(!continues(plan(6, 0), plan(6, 0.31), 100ms));
}

TEST_CASE("what plans do after half a second does not matter") {
  auto turning = plan(20, 0);
  turning[6].y_m = 5;
  CHECK(continues(plan(20, 0), turning, 100ms));
  turning[5].y_m = 5;
  CHECK(!continues(plan(20, 0), turning, 100ms));
}

TEST_CASE("plans that are not known for half a second may not follow") {
  CHECK(!continues(plan(5, 0), plan(6, 0), 100ms));
  CHECK(!continues(plan(6, 0), plan(5, 0), 100ms));
  CHECK(!continues({}, {}, 100ms));
}

TEST_CASE("a step that does not divide half a second is looked at beyond it") {
  CHECK(!continues(plan(3, 0), plan(3, 0), 200ms));
  CHECK(continues(plan(4, 0), plan(4, 0), 200ms));
}

TEST_CASE("a position that is no number agrees with none") {
  auto broken = plan(6, 0);
  broken[3].y_m = std::numeric_limits<double>::quiet_NaN();
  CHECK(!continues(plan(6, 0), broken, 100ms));
}
