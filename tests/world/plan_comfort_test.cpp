// How smooth plans are, and how far one is from the next.
#include "world/vehicle/plan_comfort.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace sofof;
using namespace sofof::world;
using sofof::test::near;

namespace {

struct moment {
  double speed_mps = 0;
  double accel_mps2 = 0;
  double curvature_1pm = 0;
};

/// A plan in steps of 0.1 s; where it leads does not matter.
trajectory plan_of(const std::vector<moment>& moments) {
  trajectory plan;
  for (const auto& m : moments)
    plan.points.push_back({0.1 * static_cast<double>(plan.points.size()),
                           0,
                           {},
                           0,
                           m.curvature_1pm,
                           m.speed_mps,
                           m.accel_mps2});
  return plan;
}

/// Straight on at 10 m/s, turned by `heading_rad`, from a point on.
trajectory straight_on(point from, double heading_rad) {
  const point tangent{std::cos(heading_rad), std::sin(heading_rad)};
  trajectory plan;
  for (auto i = 0; i <= 20; ++i)
    plan.points.push_back(
        {0.1 * i, 1.0 * i, from + 1.0 * i * tangent, heading_rad, 0, 10, 0});
  return plan;
}

} // namespace

TEST_CASE("lateral acceleration is the largest v² κ, left or right") {
  const auto x =
      extremes_of(plan_of({{10, 0, 0.01}, {8, 0, -0.03}, {5, 0, 0}}));
  CHECK(x.lateral_accel_mps2 == near(1.92, 1e-12));
}

TEST_CASE("jerk is the change of acceleration from point to point, up or "
          "down") {
  CHECK(extremes_of(plan_of({{5, 0}, {5, 0.1}, {5, -0.2}})).jerk_mps3
        == near(3, 1e-12));
  CHECK(extremes_of(plan_of({{5, 0.1}, {5, 0.5}, {5, 0.4}})).jerk_mps3
        == near(4, 1e-12));
}

TEST_CASE("how hard a plan brakes is its lowest acceleration, never above "
          "zero") {
  CHECK(extremes_of(plan_of({{9, 1}, {9, -2}, {9, -1}})).min_accel_mps2 == -2);
  CHECK(extremes_of(plan_of({{9, 1}, {9, 1}})).min_accel_mps2 == 0);
}

TEST_CASE("letting go of the brake at rest is no jerk, driving off is") {
  CHECK(extremes_of(plan_of({{0.09, -0.5}, {0, 0}, {0, 0}})).jerk_mps3 == 0);
  CHECK(extremes_of(plan_of({{0.11, -0.5}, {0, 0}, {0, 0}})).jerk_mps3
        == near(5, 1e-12));
  CHECK(extremes_of(plan_of({{0, 0}, {0.02, 0.5}})).jerk_mps3
        == near(5, 1e-12));
}

TEST_CASE("a plan that goes on as the last one did jumps nowhere") {
  const auto x =
      jump_between(straight_on({0, 0}, 0.4), straight_on({0, 0}, 0.4),
                   time_point{from_seconds(0.73)});
  CHECK(x.d_m == 0);
  CHECK(x.curvature_1pm == 0);
  CHECK(x.speed_mps == 0);
  CHECK(x.accel_mps2 == 0);
}

TEST_CASE("a jump to the side counts, one along the way does not") {
  const auto heading_rad = 2.5;
  const point ahead{std::cos(heading_rad), std::sin(heading_rad)};
  const point left{-ahead.y_m, ahead.x_m};
  const auto old = straight_on({3, 4}, heading_rad);
  const auto jump_to = [&](point offset) {
    return jump_between(old, straight_on(point{3, 4} + offset, heading_rad),
                        time_point{from_seconds(0.73)})
        .d_m;
  };
  CHECK(jump_to(0.2 * left) == near(0.2, 1e-12));
  CHECK(jump_to(-0.2 * left) == near(0.2, 1e-12));
  CHECK(jump_to(0.2 * ahead) < 1e-12);
}

TEST_CASE("a jump is measured when the new plan takes over, not where it "
          "begins") {
  const auto old = plan_of({{10, 0, 0}, {10, 0, 0.01}, {10, 0, 0.02}});
  auto next = plan_of({{10, -1, 0.02}, {9, -2, 0.04}, {8, -3, 0.06}});
  next.start = time_point{from_seconds(0.05)};
  const auto x = jump_between(old, next, time_point{from_seconds(0.1)});
  CHECK(x.curvature_1pm == near(0.02, 1e-12));
  CHECK(x.speed_mps == near(0.4875, 1e-12)); // at constant jerk
  CHECK(x.accel_mps2 == near(1.5, 1e-12));
}

TEST_CASE("the plans of two vehicles are counted together") {
  plan_figures sum{3, 1, 1, 2, 3, 0, {1.5, 0.5, -1}};
  sum.add({2, 0, 10, 20, 30, 4, {1, 2, -2}});
  CHECK(sum.count == 5);
  CHECK(sum.emergency == 1);
  CHECK(sum.kept == 11);
  CHECK(sum.stops == 22);
  CHECK(sum.imperfect == 33);
  CHECK(sum.safe_stops == 4);
  CHECK(sum.extremes.lateral_accel_mps2 == 1.5);
  CHECK(sum.extremes.jerk_mps3 == 2);
  CHECK(sum.extremes.min_accel_mps2 == -2);
}
