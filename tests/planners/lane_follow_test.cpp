// Single plans: where they start, what they keep, how they go on.
#include "planners/trajectory/lane_follow.hpp"

#include "tests/planners/usual_drive.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using doctest::Approx;
using test::driving;
using test::now;
using test::town;

TEST_CASE("a plan has its points in equal steps over its horizon") {
  lane_follow planner{test::oval(town), {}};
  trajectory plan;
  planner.plan(now, driving(10, 8), nullptr, plan);
  REQUIRE(plan.points.size() == 61);
  CHECK(plan.start == now);
  CHECK(plan.end() == now + from_seconds(6));
  CHECK(plan.points.front().s_m == 10);
  CHECK(plan.points.front().speed_mps == 8);
  for (std::size_t i = 1; i < plan.points.size(); ++i) {
    const auto &a = plan.points[i - 1], &b = plan.points[i];
    CHECK(b.t_s == Approx(0.1 * static_cast<double>(i)));
    CHECK(b.s_m > a.s_m);
    CHECK(std::abs(b.heading_rad - a.heading_rad) < 0.3);
  }
}

TEST_CASE("a plan's points stay where they are in memory") {
  lane_follow planner{test::oval(town), {}};
  trajectory plan;
  planner.plan(now, driving(10, 8), nullptr, plan);
  const auto* points = plan.points.data();
  planner.plan(now, driving(20, 8), nullptr, plan);
  CHECK(plan.points.data() == points);
}

TEST_CASE("a plan made on the way continues the plan made before") {
  const auto way = test::oval(town);
  lane_follow planner{way, {}};
  auto x = driving(5, 0);
  x.d_m = 0.3;
  x.others.stop_at_m = 650;
  trajectory plan, before;
  planner.plan(now, x, nullptr, plan);
  for (auto cycle = 1; cycle < 20 * 80; ++cycle) {
    const auto t = now + cycle * from_seconds(0.05);
    std::swap(plan, before);
    auto input = seen_from(*way, before.at(t));
    input.at = t;
    input.others = x.others;
    planner.plan(t, input, nullptr, plan);
    CAPTURE(to_seconds(t - now));
    for (const auto ahead : {0.0, 1.0, 3.0, 5.5}) {
      const auto p = plan.at(t + from_seconds(ahead));
      const auto q = before.at(t + from_seconds(ahead));
      REQUIRE(distance_m(p.at, q.at) < 0.002 + 0.02 * ahead);
      REQUIRE(std::abs(p.speed_mps - q.speed_mps) < 0.001 + 0.03 * ahead);
      if (q.speed_mps > 0.5) // coming to rest ends with a step
        REQUIRE(std::abs(p.accel_mps2 - q.accel_mps2) < 0.12);
    }
  }
  CHECK(plan.points.front().speed_mps == 0);
}

TEST_CASE("an old input is moved forward along the plan before") {
  const auto way = test::oval(town);
  lane_follow planner{way, {}};
  trajectory before, plan;
  planner.plan(now, driving(80, 13), nullptr, before);
  const auto later = now + from_seconds(0.4);
  SUBCASE("made from the same input") {
    planner.plan(later, driving(80, 13), &before, plan);
    CHECK(plan.points.front().s_m == Approx(before.at(later).s_m));
    CHECK(plan.points.front().accel_mps2
          == Approx(before.at(later).accel_mps2));
  }
  SUBCASE("made after the input's time") {
    auto x = driving(80 - 13 * 0.3, 13);
    x.at = now - from_seconds(0.3);
    planner.plan(later, x, &before, plan);
    CHECK(plan.points.front().s_m == Approx(before.at(later).s_m));
  }
}

TEST_CASE("a plan before that disagrees with the input, or is over, is not "
          "used") {
  lane_follow planner{test::oval(town), {}};
  trajectory before, plan;
  planner.plan(now, driving(80, 10), nullptr, before);
  SUBCASE("another place") {
    planner.plan(now, driving(82, 10), &before, plan);
    CHECK(plan.points.front().s_m == 82);
  }
  SUBCASE("another speed") {
    planner.plan(now, driving(80, 8.5), &before, plan);
    CHECK(plan.points.front().speed_mps == 8.5);
  }
  SUBCASE("over") {
    auto x = driving(150, 8);
    x.at = now + from_seconds(6.8);
    planner.plan(now + from_seconds(7), x, &before, plan);
    CHECK(plan.points.front().s_m == Approx(151.6));
  }
}

TEST_CASE("a car ahead is moved forward by the age of what is known of it") {
  lane_follow planner{test::straight(900, {{0, 13.9}}), {}};
  auto x = driving(0, 10);
  x.others.lead = lead_vehicle{1, 20, 10, 0};
  trajectory fresh, old;
  planner.plan(now, x, nullptr, fresh);
  x.others.at = now - from_seconds(0.4);
  x.others.lead->rear_s_m = 16;
  planner.plan(now, x, nullptr, old);
  CHECK(old.points.back().s_m == Approx(fresh.points.back().s_m));
}

TEST_CASE("a car beside the centre line returns to it") {
  const auto way = test::straight(900, {{0, 27.8}});
  lane_follow planner{way, {}};
  for (const auto speed : {3.0, 13.9, 27.8}) {
    auto x = driving(100, speed);
    x.d_m = 0.5;
    trajectory plan;
    planner.plan(now, x, nullptr, plan);
    CHECK(plan.points.front().at.y_m == Approx(0.5));
    for (const auto& p : plan.points) {
      CHECK(p.at.y_m > -0.01);
      CHECK(p.at.y_m <= 0.5);
      CHECK(std::abs(p.curvature_1pm) * speed * speed < 1.0);
    }
    CHECK(plan.points.back().at.y_m < 0.1);
  }
}

TEST_CASE("a line that is too close is braked for as hard as possible") {
  lane_follow planner{test::straight(900, {{0, 13.9}}), {}};
  auto x = driving(100, 13.9);
  x.others.stop_at_m = 108;
  trajectory plan;
  planner.plan(now, x, nullptr, plan);
  CHECK(plan.points[10].accel_mps2 == Approx(-6));
  CHECK(plan.points.back().speed_mps == 0);
}
