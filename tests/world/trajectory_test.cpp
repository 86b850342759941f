// Reading a plan between its points.
#include "world/vehicle/trajectory.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::world;
using doctest::Approx;

namespace {

/// Speeding up at growing acceleration on a circle of 20 m radius.
trajectory on_a_circle() {
  constexpr auto radius_m = 20.0, jerk_mps3 = 1.0;
  trajectory plan{time_point{from_seconds(7)}, {}};
  for (auto i = 0; i <= 10; ++i) {
    const auto t = 0.1 * i;
    const auto s = 5 * t + jerk_mps3 * t * t * t / 6;
    const auto angle = s / radius_m;
    plan.points.push_back(
        {t,
         s,
         {radius_m * std::sin(angle), radius_m * (1 - std::cos(angle))},
         angle,
         1 / radius_m,
         5 + jerk_mps3 * t * t / 2,
         jerk_mps3 * t});
  }
  return plan;
}

} // namespace

TEST_CASE("between its points a plan is what the car does") {
  const auto plan = on_a_circle();
  for (const auto t : {0.0, 0.03, 0.25, 0.55, 0.9999, 1.0}) {
    const auto p = plan.at(plan.start + from_seconds(t));
    CHECK(p.t_s == Approx(t));
    CHECK(p.accel_mps2 == Approx(t));
    CHECK(p.speed_mps == Approx(5 + t * t / 2));
    const auto s = 5 * t + t * t * t / 6;
    CHECK(p.s_m == Approx(s));
    CHECK(p.heading_rad == Approx(s / 20));
    const point truth{20 * std::sin(s / 20), 20 * (1 - std::cos(s / 20))};
    CHECK(distance_m(p.at, truth) < 1e-4);
  }
}

TEST_CASE("before its start and after its end a plan keeps its rim points") {
  const auto plan = on_a_circle();
  CHECK(plan.end() == time_point{from_seconds(8)});
  CHECK(plan.at(plan.start - from_seconds(3)).s_m == 0);
  CHECK(plan.at(plan.end() + from_seconds(3)).s_m == plan.points.back().s_m);
}

TEST_CASE("a standing plan stands between its points too") {
  trajectory plan;
  for (auto i = 0; i < 3; ++i)
    plan.points.push_back({0.1 * i, 4, {1, 2}, 0.5, 0.01, 0, 0});
  const auto p = plan.at(time_point{from_seconds(0.13)});
  CHECK(p.at == point{1, 2});
  CHECK(p.speed_mps == 0);
  CHECK(p.s_m == 4);
}

TEST_CASE("a plan of one point is that point at all times") {
  trajectory plan;
  plan.points.push_back({0, 4, {1, 2}, 0.5, 0, 3, 0});
  CHECK(plan.at(time_point{from_seconds(-1)}).speed_mps == 3);
  CHECK(plan.at(time_point{from_seconds(1)}).speed_mps == 3);
  CHECK(plan.end() == plan.start);
}

TEST_CASE("a plan that can be followed is sound") {
  CHECK(on_a_circle().is_sound());
}

TEST_CASE("a stranger's plan is not sound when it could mislead the car") {
  const auto spoilt = [](auto spoil) {
    auto plan = on_a_circle();
    spoil(plan.points);
    return plan.is_sound();
  };
  const auto nan = std::nan("");
  CHECK(!spoilt([](auto& p) { p.clear(); }));
  CHECK(!spoilt([](auto& p) { p.resize(1); }));
  CHECK(!spoilt([](auto& p) { p[0].t_s = 0.05; }));
  CHECK(!spoilt([](auto& p) { p[4].t_s = p[3].t_s; }));
  CHECK(!spoilt([](auto& p) { std::swap(p[4], p[5]); }));
  CHECK(!spoilt([](auto& p) { p[1].t_s = 1e-9; }));
  CHECK(!spoilt([&](auto& p) { p[2].t_s = nan; }));
  CHECK(!spoilt([](auto& p) { p[2].speed_mps = -1; }));
  CHECK(!spoilt([&](auto& p) { p[2].speed_mps = nan; }));
  CHECK(!spoilt([&](auto& p) { p[9].s_m = nan; }));
  CHECK(!spoilt([](auto& p) { p[9].at.y_m = HUGE_VAL; }));
  CHECK(!spoilt([&](auto& p) { p[9].heading_rad = nan; }));
  CHECK(!spoilt([&](auto& p) { p[9].curvature_1pm = nan; }));
  CHECK(!spoilt([&](auto& p) { p[10].accel_mps2 = nan; }));
  CHECK(!spoilt([](auto& p) { p[4].at.x_m = 1.7e308; }));
  CHECK(!spoilt([](auto& p) { p[4].speed_mps = 1e9; }));
}

TEST_CASE(
    "the rest of a plan goes on where the plan is by then, in its steps") {
  const auto plan = on_a_circle();
  const auto from = plan.start + from_seconds(0.43);
  const auto rest = rest_of(plan, from);
  CHECK(rest.start == from);
  CHECK(rest.is_sound());
  REQUIRE(rest.points.size() == 6); // to 0.93 s
  CHECK(rest.points[1].t_s == Approx(0.1));
  for (const auto& p : rest.points) {
    const auto there = plan.at(from + from_seconds(p.t_s));
    CHECK(distance_m(p.at, there.at) < 1e-9);
    CHECK(p.speed_mps == Approx(there.speed_mps));
  }
}

TEST_CASE("a plan that begins later is whole, and of one that is over nothing "
          "is left") {
  const auto plan = on_a_circle();
  CHECK(rest_of(plan, plan.start).points.size() == plan.points.size());
  CHECK(rest_of(plan, plan.start - from_seconds(1)).start == plan.start);
  CHECK(rest_of(plan, plan.end() + from_seconds(0.01)).empty());
  CHECK(rest_of({}, plan.start).empty());
}
