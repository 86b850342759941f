// Braking by the least that is safe, on the line of a plan.
#include "planners/safety/proper_response.hpp"

#include "planners/trajectory/safe_stop.hpp"
#include "tests/planners/usual_drive.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;
using test::now;

namespace {

/// A plan that leads beside the middle of a bend.
world::trajectory braking_softly(double speed_mps, double decel_mps2,
                                 double accel_mps2 = 0) {
  planning_input x;
  x.at = now;
  x.s_m = 50;
  x.d_m = 0.8;
  x.speed_mps = speed_mps;
  x.accel_mps2 = accel_mps2;
  return safe_stop(*test::oval({{0, 27.8}}), now, x, decel_mps2);
}

} // namespace

TEST_CASE(
    "who responds properly brakes at once by what is assumed of it, where "
    "the plan leads, until it stands") {
  constexpr auto decel_mps2 = 4.0;
  for (const auto speed_mps : {0.5, 3.0, 9.0, 16.0})
    for (const auto accel_mps2 : {-4.0, -1.0, 0.0, 1.5}) {
      CAPTURE(speed_mps);
      const auto before = braking_softly(speed_mps, 1.5, accel_mps2);
      auto plan = before;
      respond_properly(plan, decel_mps2);
      REQUIRE(plan.is_sound());
      REQUIRE(plan.points.size() == before.points.size());
      CHECK(plan.start == before.start);
      CHECK(plan.points.front().at == before.points.front().at);
      CHECK(plan.points.back().speed_mps == 0);
      CHECK(plan.points.back().s_m - before.points.front().s_m
            == Approx(speed_mps * speed_mps / (2 * decel_mps2)).epsilon(0.001));
      for (std::size_t k = 0; k < plan.points.size(); ++k) {
        const auto& p = plan.points[k];
        CHECK((p.speed_mps == 0 || p.accel_mps2 <= -decel_mps2));
        CHECK(p.s_m <= before.points[k].s_m + 1e-3);
        auto nearest_m = 1e9;
        for (double t_s = 0; t_s <= before.points[k].t_s; t_s += 0.002)
          nearest_m = std::min(nearest_m, distance_m(before.at(t_s).at, p.at));
        CHECK(nearest_m < 0.05);
      }
    }
}

TEST_CASE("who responds properly brakes harder where the plan does") {
  const auto before = braking_softly(15, 7);
  auto plan = before;
  respond_properly(plan, 4);
  for (std::size_t k = 0; k < plan.points.size(); ++k) {
    const auto& p = plan.points[k];
    CHECK((p.speed_mps == 0 || p.accel_mps2 <= before.points[k].accel_mps2));
  }
  CHECK(plan.at(1.5).accel_mps2 == Approx(-7).epsilon(0.001));
}

TEST_CASE("who responds properly is never ahead of its plan, however that "
          "changes its braking") {
  for (const auto accel_mps2 : {-7.0, -4.0, -2.0, 0.0, 1.5})
    for (const auto target_mps2 : {1.0, 4.0, 7.0})
      for (const auto decel_mps2 : {2.0, 4.0, 8.0}) {
        CAPTURE(accel_mps2);
        CAPTURE(target_mps2);
        CAPTURE(decel_mps2);
        const auto before = braking_softly(15, target_mps2, accel_mps2);
        auto plan = before;
        respond_properly(plan, decel_mps2);
        CHECK(plan.is_sound());
        for (std::size_t k = 0; k < plan.points.size(); ++k)
          CHECK(plan.points[k].s_m <= before.points[k].s_m + 1e-3);
      }
}

TEST_CASE("who stands and responds properly goes on standing") {
  const auto before = braking_softly(0, 2);
  auto plan = before;
  respond_properly(plan, 4);
  CHECK(plan.points.back().s_m == Approx(before.points.front().s_m));
  CHECK(plan.points.front().accel_mps2 == 0);
}
