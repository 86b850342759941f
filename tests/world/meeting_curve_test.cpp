// Where two swept bodies meet.
#include "world/roads/meeting_curve.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace sofof;
using namespace sofof::world;

namespace {

constexpr moving_body car{5, 2};

path line(std::vector<point> points) {
  return path{points};
}

path_stretch all_of(const path& p) {
  return {&p, 0, p.length_m()};
}

/// @returns whether two places are the same, up to the steps of a sweep.
bool is_about(double a_m, double b_m) {
  return std::abs(a_m - b_m) <= 2 * meeting_curve::step_m;
}

} // namespace

TEST_CASE("on a way that crosses, the other has to have crossed before") {
  const auto east = line({{-50, 0}, {50, 0}});
  const auto north = line({{0, -50}, {0, 50}});
  const meeting_curve meet{all_of(east), car, all_of(north), car};
  REQUIRE_FALSE(meet.is_empty());
  // They touch where both middles are within 3.5 m of the crossing point.
  CHECK(is_about(meet.begins_m(), 46.5));
  CHECK(meet.cleared_m(46) == meeting_curve::no_matter);
  CHECK(is_about(meet.cleared_m(47), 53.5));
  CHECK(is_about(meet.cleared_m(90), 53.5));
}

TEST_CASE("behind another on one way, its length lies between") {
  const auto east = line({{0, 0}, {100, 0}});
  const meeting_curve meet{all_of(east), car, all_of(east), car};
  for (const double at_m : {1, 20, 50, 80})
    CHECK(is_about(meet.cleared_m(at_m), at_m + 5));
}

TEST_CASE("ways side by side do not meet") {
  const auto east = line({{0, 0}, {100, 0}});
  const auto west = line({{100, 3.5}, {0, 3.5}});
  CHECK(meeting_curve(all_of(east), car, all_of(west), car).is_empty());
  CHECK(meeting_curve().is_empty());
  CHECK(meeting_curve().cleared_m(5) == meeting_curve::no_matter);
}

TEST_CASE("where ways part, the one behind is free again") {
  const auto straight = line({{0, 0}, {40, 0}, {80, 0}, {120, 0}});
  const auto parts = line({{0, 0}, {40, 0}, {80, 20}, {120, 40}});
  const meeting_curve meet{all_of(parts), car, all_of(straight), car};
  REQUIRE_FALSE(meet.is_empty());
  CHECK(is_about(meet.cleared_m(20), 25));
  CHECK(meet.ends_m() < 70);
  CHECK(meet.cleared_m(110) == meet.cleared_m(meet.ends_m()));
}

TEST_CASE("where the first has come as far as the curve says, bodies do not "
          "touch") {
  test::dice dice{3};
  for (int k = 0; k < 60; ++k) {
    const auto any = [&] {
      return point{dice.between(-40, 40), dice.between(-40, 40)};
    };
    const auto a = line({any(), any(), any()});
    const auto b = line({any(), any(), any()});
    const moving_body large{dice.between(1, 8), dice.between(0.5, 3)};
    const meeting_curve meet{all_of(a), large, all_of(b), car};
    for (int n = 0; n < 60; ++n) {
      const auto second_m = dice.between(0, b.length_m());
      const auto cleared_m = meet.cleared_m(second_m);
      const auto first_m = dice.between(std::max(0.0, cleared_m), a.length_m());
      if (first_m < cleared_m || first_m > a.length_m())
        continue;
      const auto p = a.at(first_m), q = b.at(second_m);
      // Less what one step moves the outline.
      CHECK_FALSE(overlap(
          {p.at, p.heading_rad, large.length_m - 0.5, large.width_m - 0.5},
          {q.at, q.heading_rad, car.length_m - 0.5, car.width_m - 0.5}));
    }
  }
}
