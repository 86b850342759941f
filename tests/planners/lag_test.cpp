// Driving alone to a crossing, and how long one car keeps another out of it.
#include "planners/crossing/lag.hpp"

#include "planners/crossing/order_problem.hpp"
#include "tests/planners/crossing_cases.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

namespace {

const test::four_arms& crossing() {
  static const test::four_arms one;
  return one;
}

/// The number of a way from one arm to another.
std::size_t way(std::size_t in, std::size_t out) {
  for (std::size_t i = 0; i < test::four_arms::ways; ++i)
    if (crossing().arms(i) == std::pair{in, out})
      return i;
  return test::four_arms::ways;
}

constexpr std::size_t east = 1, north = 2, west = 3, south = 4;

way_motion from(std::size_t i, double before_line_m, double speed_mps) {
  const auto& profile = crossing().way(i);
  return drive_freely(profile, {}, crossing().line_m(i) - before_line_m,
                      speed_mps, profile.line.way().length_m());
}

double lag(std::size_t a, double a_m, std::size_t b, double b_m,
           double speed_mps = 10) {
  const auto first = from(a, a_m, speed_mps), second = from(b, b_m, speed_mps);
  return delay_s(crossing().meet(a, b), first, second, {0.5, 0})
         + second.time_s(crossing().line_m(b))
         - first.time_s(crossing().line_m(a));
}

} // namespace

TEST_CASE("a car alone speeds up to what its way allows, and is there when it "
          "is") {
  const auto x = from(way(east, west), 100, 0);
  const auto line_m = crossing().line_m(way(east, west));
  // 1.25 m/s² up to 10 m/s takes 40 m and 8 s.
  CHECK(x.time_s(line_m) == Approx(8 + (100 - 40) / 10.0).epsilon(0.01));
  CHECK(x.time_s(line_m - 100) == 0);
  CHECK(x.time_s(line_m - 110) < 0);
  CHECK(x.time_s(x.ends_m() + 10) == Approx(x.time_s(x.ends_m()) + 1));
  auto last_s = -1e9;
  for (auto s = line_m - 120; s < line_m + 150; s += 0.7) {
    CHECK(x.time_s(s) > last_s);
    last_s = x.time_s(s);
  }
}

TEST_CASE("ways that do not meet have no lag") {
  CHECK(lag(way(east, north), 50, way(west, south), 50)
        == order_problem::never_meet);
  CHECK(lag(way(east, west), 50, way(west, east), 50)
        == order_problem::never_meet);
}

TEST_CASE("across, the second is at its line when the first has cleared the "
          "place where they meet") {
  const auto a = way(east, west), b = way(south, north);
  const auto lag_ab = lag(a, 60, b, 60);
  // At 10 m/s: the first clears about 3.5 m behind the middle of its way, the
  // second touches 3.5 m before the middle; their ways beside the middle are
  // 1.75 m longer and shorter.
  CHECK(lag_ab > 0.5);
  CHECK(lag_ab < 0.5 + 1.5);
  CHECK(lag(b, 60, a, 60) > 0.5);
}

TEST_CASE(
    "the nearer a car stands, the longer it takes to get out of the way") {
  const auto a = way(east, west), b = way(south, north);
  CHECK(lag(a, 3, b, 60, 0) > lag(a, 60, b, 60, 0));
}

TEST_CASE("who has cleared the place keeps nobody out of it") {
  const auto a = way(east, west), b = way(south, north);
  const auto first = from(a, -30, 10), second = from(b, 60, 10);
  CHECK(delay_s(crossing().meet(a, b), first, second, {0.5, 0})
        == order_problem::never_meet);
}

TEST_CASE("driven with their lags, two cars do not touch") {
  test::dice dice{5};
  for (int k = 0; k < 200; ++k) {
    const auto a = static_cast<std::size_t>(dice.between(0, 12));
    const auto b = static_cast<std::size_t>(dice.between(0, 12));
    const auto first_m = dice.between(5, 100), second_m = dice.between(5, 100);
    const auto same_lane = crossing().arms(a).first == crossing().arms(b).first;
    if (same_lane && second_m < first_m + 6)
      continue; // the second one is ahead
    const auto first = from(a, first_m, dice.between(0, 8));
    const auto second = from(b, second_m, dice.between(0, 8));
    // The second one sets off so much later that it just keeps the lag.
    const auto later_s = delay_s(crossing().meet(a, b), first, second, {});
    if (!std::isfinite(later_s))
      continue;
    const auto& path_a = crossing().way(a).line.way().path();
    const auto& path_b = crossing().way(b).line.way().path();
    for (auto s = second.begins_m(); s < second.ends_m() - 10; s += 0.5) {
      const auto t = second.time_s(s) + later_s;
      if (t < 0)
        continue;
      auto at_m = first.begins_m(); // of the first one then
      while (at_m < first.ends_m() && first.time_s(at_m + 0.1) <= t)
        at_m += 0.1;
      if (at_m >= first.ends_m())
        break; // it has left
      const auto p = path_a.at(at_m), q = path_b.at(s);
      CHECK_FALSE(overlap({p.at, p.heading_rad, 5.1, 1.89},
                          {q.at, q.heading_rad, 5.1, 1.89}));
    }
  }
}
