// Single plans of the optimiser: sound whatever comes in, honest about how
// they came about.
#include "planners/trajectory/spatial_planner.hpp"

#include "planners/scene/lane_motion.hpp"
#include "tests/planners/random_road.hpp"
#include "tests/planners/usual_drive.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <limits>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using doctest::Approx;
using test::driving;
using test::now;

namespace {

constexpr auto cycle = std::chrono::milliseconds{50};

constexpr auto refuse = [](int) noexcept { return false; };

bool same(const trajectory_point& a, const trajectory_point& b) {
  return a.t_s == b.t_s && a.s_m == b.s_m && a.at.x_m == b.at.x_m
         && a.at.y_m == b.at.y_m && a.heading_rad == b.heading_rad
         && a.curvature_1pm == b.curvature_1pm && a.speed_mps == b.speed_mps
         && a.accel_mps2 == b.accel_mps2;
}

/// A planner that drives on exactly as it plans.
struct ride {
  explicit ride(route_ptr on, double s_m, double speed_mps,
                spatial_params params = {})
      : way{std::move(on)}, planner{test::optimiser(way, params)},
        input{driving(s_m, speed_mps)} {}

  /// One cycle; the first is at `now`.
  void go(const ocp::budget& go_on = {}) {
    if (!plan.empty()) {
      t += cycle;
      auto others = input.others;
      input = seen_from(*way, plan.at(t));
      input.others = std::move(others);
    }
    input.at = t;
    input.others.at = t;
    std::swap(plan, before);
    report = planner->plan(t, input, before.empty() ? nullptr : &before, plan,
                           go_on);
  }

  route_ptr way;
  test::planner_ptr planner;
  planning_input input;
  time_point t = now;
  trajectory plan, before;
  plan_report report;
};

/// What comes in when sensors, links or programmers fail.
planning_input junk(test::dice& dice) {
  constexpr auto infinite = std::numeric_limits<double>::infinity();
  const auto number = [&](double sane) {
    switch (static_cast<int>(dice.between(0, 12))) {
      case 0:
        return std::numeric_limits<double>::quiet_NaN();
      case 1:
        return infinite;
      case 2:
        return -infinite;
      case 3:
        return -1e12;
      case 4:
        return 1e12;
      case 5:
        return -sane;
      default:
        return sane;
    }
  };
  auto x = driving(number(dice.between(0, 300)), number(dice.between(0, 20)));
  x.at = now + from_seconds(dice.between(-3, 1));
  x.others.at = now + from_seconds(dice.between(-3, 1));
  x.d_m = number(dice.between(-1, 1));
  x.heading_error_rad = number(dice.between(-0.2, 0.2));
  x.curvature_1pm = number(dice.between(-0.1, 0.1));
  x.accel_mps2 = number(dice.between(-2, 2));
  if (dice.between(0, 1) < 0.5)
    x.others.lead =
        lead_vehicle{1, number(dice.between(0, 300)),
                     number(dice.between(0, 20)), number(dice.between(-6, 2))};
  if (dice.between(0, 1) < 0.5)
    x.others.stop_at_m = number(dice.between(0, 300));
  for (auto n = dice.between(-2, 3); n > 0; --n)
    x.others.crossings.push_back(
        {number(dice.between(0, 300)), number(dice.between(0, 300)),
         number(dice.between(0, 9)), number(dice.between(0, 12)),
         dice.between(0, 1) < 0.5, number(dice.between(0, 9)),
         static_cast<std::uint32_t>(dice.between(0, 3))});
  for (auto n = dice.between(-2, 6); n > 0; --n)
    x.others.beside.push_back(
        {number(dice.between(0, 300)), number(dice.between(0, 300)),
         number(dice.between(-2, 2)), number(dice.between(-2, 2)),
         number(dice.between(-9, 9))});
  return x;
}

} // namespace

TEST_CASE("a plan of the optimiser has its points in equal steps from now on") {
  ride ride{test::oval({{0, 13.9}}), 10, 8};
  ride.go();
  CHECK(ride.plan.is_sound());
  REQUIRE(ride.plan.points.size() == 61);
  CHECK(ride.plan.start == now);
  CHECK(ride.plan.end() == now + from_seconds(6));
  CHECK(ride.plan.points.front().s_m == Approx(10));
  CHECK(ride.plan.points.front().speed_mps == Approx(8));
  CHECK(ride.report.origin == plan_origin::planned);
  CHECK(ocp::publishable(ride.report.path));
  CHECK(ocp::publishable(ride.report.velocity));
  CHECK(!ride.report.emergency);
  CHECK(ride.report.input == now);
  CHECK(ride.report.iterations > 0);
}

TEST_CASE("from anywhere on any road comes a sound plan that begins there and "
          "drives where it says") {
  test::dice dice{1};
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    ride ride{test::random_road(seed), dice.between(10, 300),
              dice.between(0, 8)};
    ride.input.d_m = dice.between(-0.5, 0.5);
    ride.input.heading_error_rad = dice.between(-0.05, 0.05);
    ride.go();
    REQUIRE(ride.plan.is_sound());
    const auto from = seen_from(*ride.way, ride.plan.points.front());
    CHECK(from.s_m == Approx(ride.input.s_m));
    CHECK(from.d_m == Approx(ride.input.d_m));
    CHECK(from.heading_error_rad == Approx(ride.input.heading_error_rad));
    CHECK(from.speed_mps == Approx(ride.input.speed_mps));
    for (std::size_t i = 1; i < ride.plan.points.size(); ++i) {
      const auto &a = ride.plan.points[i - 1], &b = ride.plan.points[i];
      const auto way = 0.05 * (a.speed_mps + b.speed_mps);
      CHECK(distance_m(a.at, b.at) == Approx(way).epsilon(0.02).scale(0.1));
      const auto turn = wrap_angle(b.heading_rad - a.heading_rad);
      CHECK(std::abs(turn - way * (a.curvature_1pm + b.curvature_1pm) / 2)
            < 0.05);
    }
  }
}

TEST_CASE("whatever comes in, a sound plan comes out") {
  const auto way = test::random_road(7);
  test::dice dice{2};
  for (auto i = 0; i < 400; ++i) {
    CAPTURE(i);
    spatial_params params;
    params.candidates = i % 3 + 1;
    const auto planner = test::optimiser(way, params);
    trajectory plan, before;
    for (auto k = 0; k < 4; ++k) {
      auto x = k % 2 == 1 ? junk(dice) : driving(20 + 0.5 * k, 10);
      const auto t = now + k * cycle;
      x.at += k * cycle;
      x.others.at += k * cycle;
      std::swap(plan, before);
      planner->plan(t, x, k == 0 ? nullptr : &before, plan);
      CAPTURE(k);
      CHECK(plan.is_sound());
      CHECK(plan.start == t);
    }
    // And nothing of it is left.
    const auto x = driving(60, 10);
    const auto report = planner->plan(now, x, nullptr, plan);
    CHECK(report.origin == plan_origin::planned);
    CHECK(plan.points.front().s_m == Approx(60));
  }
}

TEST_CASE("junk as the very first input gives a sound plan, too") {
  const auto way = test::random_road(7);
  test::dice dice{3};
  for (auto i = 0; i < 400; ++i) {
    CAPTURE(i);
    const auto planner = test::optimiser(way);
    trajectory plan;
    planner->plan(now, junk(dice), nullptr, plan);
    CHECK(plan.is_sound());
    CHECK(plan.start == now);
  }
}

TEST_CASE("without time the plan before is kept for a second at most, then "
          "the car brakes") {
  ride ride{test::straight(600, {{0, 13.9}}), 20, 12};
  for (auto i = 0; i < 10; ++i)
    ride.go();
  REQUIRE(ride.report.origin == plan_origin::planned);
  const auto last = ride.plan;
  const ocp::budget none{refuse};
  // Too near, but going away: new plans would not do, the old one does.
  lead_vehicle lead{1, last.points.front().s_m + 4.0175 + 8, 14, 0};
  auto stopped = 0;
  for (auto i = 1; i <= 30; ++i) {
    lead.rear_s_m += 0.05 * lead.speed_mps;
    ride.input.others.lead = lead;
    ride.go(none);
    CAPTURE(i);
    REQUIRE(ride.plan.is_sound());
    const auto age_s = to_seconds(ride.t - last.start);
    if (age_s < 0.99) {
      CHECK(ride.report.origin == plan_origin::kept);
      CHECK(!ride.report.emergency);
      for (const auto ahead : {0.0, 1.0, 3.0}) {
        const auto when = ride.t + from_seconds(ahead);
        CHECK(distance_m(ride.plan.at(when).at, last.at(when).at) < 0.01);
      }
    }
    // One who stops hard and finds a plan again keeps that for a while.
    CHECK(ride.report.emergency
          == (ride.report.origin == plan_origin::stop
              || ride.report.extremes.value().jerk_mps3 > 2));
    stopped += ride.report.origin == plan_origin::stop ? 1 : 0;
  }
  CHECK(stopped > 0);
  for (auto i = 0; i < 3; ++i)
    ride.go();
  CHECK(ride.report.origin == plan_origin::planned);
}

TEST_CASE("without time the plan before is not kept where it would hit "
          "somebody") {
  ride ride{test::straight(600, {{0, 13.9}}), 20, 12};
  for (auto i = 0; i < 10; ++i)
    ride.go();
  ride.input.others.lead =
      lead_vehicle{1, ride.plan.points.front().s_m + 40, 0, 0};
  ride.go(ocp::budget{refuse});
  CHECK(ride.report.origin != plan_origin::kept);
  CHECK(ride.report.emergency);
  CHECK(ride.plan.points.back().speed_mps == 0);
  CHECK(ride.plan.points.back().s_m + 4.0175
        < ride.input.others.lead->rear_s_m);
}

TEST_CASE(
    "without time the plan before is kept past a body that leaves room, and "
    "only then") {
  for (const auto [low_m, leaves_room] :
       {std::pair{1.1, true}, std::pair{0.8, false}}) {
    ride ride{test::straight(600, {{0, 13.9}}), 20, 12};
    for (auto i = 0; i < 10; ++i)
      ride.go();
    const auto s_m = ride.plan.points.front().s_m;
    ride.input.others.beside = {{s_m + 15, s_m + 19, low_m, low_m + 1, 0}};
    ride.go(ocp::budget{refuse});
    CHECK((ride.report.origin == plan_origin::kept) == leaves_room);
  }
}

TEST_CASE("when there is no time for a path round a body, the speed is planned "
          "to stop before it") {
  ride ride{test::straight(600, {{0, 13.9}}), 20, 12, {.candidates = 1}};
  for (auto i = 0; i < 10; ++i)
    ride.go();
  const auto s_m = ride.plan.points.front().s_m;
  ride.input.others.beside = {{s_m + 60, s_m + 64, -2.3, -0.85, 0}};
  auto asked = 0; // by the path's warm and cold start, then by the speed's
  const auto not_for_the_path = [&asked](int) noexcept { return ++asked > 2; };
  ride.go(ocp::budget{not_for_the_path});
  CHECK(ride.report.origin == plan_origin::planned);
  CHECK(ride.report.path == ocp::solve_status::budget);
  CHECK(ride.plan.points.back().s_m + 4.0175 < s_m + 60);
  CHECK_FALSE(ride.report.emergency);
}

TEST_CASE("without time from the beginning the car stops in its lane") {
  ride ride{test::random_road(3), 30, 8};
  for (auto i = 0; i < 5; ++i) {
    ride.go(ocp::budget{refuse});
    CHECK(ride.report.origin != plan_origin::planned);
    CHECK(ride.report.emergency);
    CHECK(ride.plan.is_sound());
    CHECK(ride.plan.points.back().speed_mps == 0);
    CHECK(std::abs(seen_from(*ride.way, ride.plan.points.back()).d_m) < 0.3);
  }
}

TEST_CASE("the same cycles give the same plans, bit by bit") {
  const auto way = test::random_road(5);
  const auto drive = [&] {
    ride ride{way, 10, 5};
    ride.input.others.lead = lead_vehicle{1, 60, 5, 0};
    ride.input.others.beside = {{100, 104, -2, -0.95, 0}};
    ride.input.others.crossings = {{150, 155, 4, 6, true}};
    std::vector<trajectory_point> all;
    for (auto i = 0; i < 200; ++i) {
      ride.input.others.lead->rear_s_m += 0.25;
      ride.go();
      all.insert(all.end(), ride.plan.points.begin(), ride.plan.points.end());
    }
    return all;
  };
  const auto once = drive(), twice = drive();
  REQUIRE(once.size() == twice.size());
  for (std::size_t i = 0; i < once.size(); ++i)
    REQUIRE(same(once[i], twice[i]));
}

TEST_CASE("a planner that takes over goes on from the plan in use, and soon "
          "plans as its owner would have") {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    CAPTURE(seed);
    const auto way = test::random_road(seed);
    ride ride{way, 20, 6};
    for (auto i = 0; i < 60 + static_cast<int>(seed); ++i)
      ride.go();
    const auto other = test::optimiser(way);
    auto t = ride.t;
    trajectory plan, before = ride.plan;
    auto iterations = 0;
    for (auto i = 0; i < 10; ++i) {
      t += cycle;
      auto x = seen_from(*way, before.at(t));
      x.at = t;
      x.others.at = t;
      const auto report = other->plan(t, x, &before, plan);
      CAPTURE(i);
      CHECK(report.origin == plan_origin::planned);
      const auto a = before.at(t), b = plan.at(t);
      CHECK(distance_m(a.at, b.at) < 0.01);
      CHECK(std::abs(a.speed_mps - b.speed_mps) < 0.02);
      CHECK(std::abs(a.accel_mps2 - b.accel_mps2) < 0.05);
      CHECK(std::abs(a.curvature_1pm - b.curvature_1pm) < 0.002);
      iterations = report.iterations;
      std::swap(plan, before);
      ride.go();
      const auto later = t + from_seconds(1.5);
      CHECK(distance_m(ride.plan.at(later).at, before.at(later).at) < 0.1);
    }
    CHECK(iterations < 60);
  }
}

TEST_CASE("a planner that comes back begins where the plan in use is, not on "
          "its own old path") {
  const auto way = test::straight(600, {{0, 13.9}});
  ride ride{way, 20, 10};
  for (auto i = 0; i < 20; ++i)
    ride.go();
  // Meanwhile another planner has led the car a little to the side.
  const auto other = test::optimiser(way);
  auto x = seen_from(*way, ride.plan.at(ride.t + cycle));
  x.d_m += 0.04;
  x.at = x.others.at = ride.t + cycle;
  trajectory theirs;
  other->plan(ride.t + cycle, x, nullptr, theirs);
  ride.plan = theirs;
  ride.t += cycle;
  ride.go();
  CHECK(ride.report.origin == plan_origin::planned);
  for (const auto ahead : {0.0, 0.5}) {
    const auto when = ride.t + from_seconds(ahead);
    CHECK(distance_m(ride.plan.at(when).at, theirs.at(when).at) < 0.005);
  }
}
