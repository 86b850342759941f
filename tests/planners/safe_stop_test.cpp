// The last resort.
#include "planners/trajectory/safe_stop.hpp"

#include "tests/planners/usual_drive.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;
using test::now;

namespace {

planning_input rolling(double s_m, double speed_mps) {
  planning_input x;
  x.at = now;
  x.s_m = s_m;
  x.speed_mps = speed_mps;
  return x;
}

} // namespace

TEST_CASE("a safe stop ends at rest and stays there") {
  const auto way = test::oval({{0, 27.8}});
  for (const auto speed : {0.0, 0.3, 3.0, 13.9, 27.8})
    for (const auto accel : {-5.0, 0.0, 1.5}) {
      CAPTURE(speed);
      auto x = rolling(50, speed);
      x.accel_mps2 = accel;
      const auto plan = safe_stop(*way, now, x);
      REQUIRE(plan.start == now);
      REQUIRE(plan.end() >= now + from_seconds(6));
      const auto rest = plan.at(plan.end() - from_seconds(1));
      CHECK(rest.speed_mps == 0);
      CHECK(rest.accel_mps2 == 0);
      CHECK(plan.points.back().at == rest.at);
      CHECK(rest.s_m < 50 + speed * speed / (2 * 4.0) + 0.7 * speed + 0.3);
    }
}

TEST_CASE("it brakes firmly, but builds up and lets go with limited jerk") {
  const auto way = test::straight(500, {{0, 27.8}});
  const auto plan = safe_stop(*way, now, rolling(0, 20), 5);
  auto strongest = 0.0;
  for (std::size_t i = 1; i < plan.points.size(); ++i) {
    const auto &a = plan.points[i - 1], &b = plan.points[i];
    CHECK(b.s_m >= a.s_m);
    CHECK(b.speed_mps <= a.speed_mps);
    CHECK(std::abs(b.accel_mps2 - a.accel_mps2) <= 1.0 + 1e-9);
    strongest = std::min(strongest, b.accel_mps2);
  }
  CHECK(strongest == Approx(-5));
}

TEST_CASE("it stays on the lane, and others do not matter") {
  const auto way = test::oval({{0, 13.9}});
  auto x = rolling(270, 8);
  x.d_m = 0.4;
  x.others.stop_at_m = 271;
  x.others.lead = lead_vehicle{1, 275, 0, 0};
  const auto plan = safe_stop(*way, now, x);
  for (const auto& p : plan.points)
    CHECK(std::abs(way->path().project(p.at, p.s_m, 5).d_m) <= 0.4 + 1e-6);
  CHECK(plan.points.back().s_m > 275);
}

TEST_CASE("an old state is moved forward to the start of the plan") {
  const auto way = test::straight(500, {{0, 13.9}});
  auto x = rolling(100, 10);
  x.at = now - from_seconds(0.4);
  CHECK(safe_stop(*way, now, x).points.front().s_m == Approx(104));
}
