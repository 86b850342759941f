// Speeds on a path: what they keep to, and what happens where that is too
// much.
#include "planners/speed/speed_planner.hpp"

#include "planners/speed/clearance.hpp"
#include "tests/planners/random_road.hpp"
#include "tests/planners/usual_drive.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using doctest::Approx;
using test::style;

namespace {

/// The line itself as a path, from `s_m` on.
planned_path middle(const reference_line& line, double s_m, double length_m) {
  planned_path path;
  path.start_s_m = s_m;
  path.size = std::min(planned_path::capacity, 201);
  path.ds_m = length_m / (path.size - 1);
  for (auto k = 0; k < path.size; ++k)
    path.knots[static_cast<std::size_t>(k)].x.curvature_1pm =
        line.curvature_1pm(s_m + k * path.ds_m);
  path.measure([&](double s) { return line.curvature_1pm(s); });
  return path;
}

/// A street and who plans on it.
struct planned_street {
  explicit planned_street(route_ptr way, double length_m = 400)
      : way{std::make_shared<route_profile>(std::move(way), style)},
        path{middle(this->way->line, 0, length_m)}, planner{this->way,
                                                            style,
                                                            {1, 80}} {}

  speed_planner::result plan(const speed_constraints& task, double way_m = 5) {
    return planner.plan(path, way_m, task);
  }
  const speed_profile& motion() const { return planner.motion(); }

  route_profile_ptr way;
  planned_path path;
  speed_planner planner;
};

planned_street town_street(double limit_mps = 14) {
  return planned_street{test::straight(600, {{0, limit_mps}})};
}

speed_constraints constraints_at(double speed_mps, double accel_mps2 = 0) {
  speed_constraints t;
  t.speed_mps = speed_mps;
  t.accel_mps2 = accel_mps2;
  return t;
}

void check_whole(const speed_profile& motion, const speed_constraints& task) {
  REQUIRE(motion.size() > 1);
  CHECK(motion[0].s_m == 0);
  CHECK(motion[0].speed_mps == Approx(task.speed_mps));
  for (std::size_t i = 1; i < motion.size(); ++i) {
    REQUIRE(motion[i].s_m >= motion[i - 1].s_m - 1e-4);
    REQUIRE(motion[i].speed_mps >= 0);
  }
}

double worst_jerk(const speed_profile& motion) {
  auto worst = 0.0;
  for (std::size_t i = 1; i < motion.size(); ++i)
    if (motion[i].speed_mps > 0)
      worst = std::max(
          worst, std::abs(motion[i].accel_mps2 - motion[i - 1].accel_mps2));
  return worst / style.step_s;
}

double least_accel(const speed_profile& motion) {
  return std::ranges::min_element(motion, {}, &lane_motion::accel_mps2)
      ->accel_mps2;
}

/// When a motion comes to a place; infinite if never.
double when_s(const speed_profile& motion, double way_m) {
  for (std::size_t i = 1; i < motion.size(); ++i)
    if (motion[i].s_m > way_m) {
      const auto &a = motion[i - 1], &b = motion[i];
      return style.step_s
             * (static_cast<double>(i) - 1 + (way_m - a.s_m) / (b.s_m - a.s_m));
    }
  return speed_constraints::never;
}

} // namespace

TEST_CASE("on random roads a car keeps the limits and the comfort, plan after "
          "plan") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    const auto way = test::random_road(seed, 500);
    planned_street here{way};
    auto task = constraints_at(0);
    for (auto at = 5.0; at < 300;) {
      CAPTURE(at);
      const auto r = here.plan(task, at);
      REQUIRE(r.how == speed_mode::optimal);
      REQUIRE(!r.emergency);
      CHECK(ocp::publishable(r.report.status));
      const auto& motion = here.motion();
      check_whole(motion, task);
      CHECK(motion[0].accel_mps2 == Approx(task.accel_mps2).epsilon(0.01));
      CHECK(worst_jerk(motion) < 1.02 * style.max_jerk_mps3);
      for (const auto& x : motion) {
        REQUIRE(x.accel_mps2 < 1.02 * style.max_accel_mps2);
        REQUIRE(x.accel_mps2 > -1.02 * style.firm_decel_mps2());
        const auto s = here.path.s_m(at + x.s_m);
        const auto v = x.speed_mps;
        REQUIRE(v < 1.02 * way->limit_mps(s));
        REQUIRE(v * v * std::abs(here.path.curvature_1pm(s))
                < 1.02 * style.max_lateral_accel_mps2);
      }
      at += motion[1].s_m;
      task.speed_mps = motion[1].speed_mps;
      task.accel_mps2 = motion[1].accel_mps2;
    }
  }
}

TEST_CASE("a free car reaches the limit and not more") {
  auto here = town_street();
  auto task = constraints_at(0);
  for (auto t = 0.0; t < 20; t += style.step_s) {
    here.plan(task, 5);
    task.speed_mps = here.motion()[1].speed_mps;
    task.accel_mps2 = here.motion()[1].accel_mps2;
  }
  CHECK(task.speed_mps > 13.5);
  CHECK(task.speed_mps < 14.01);
}

TEST_CASE("a car stops just before where it must, in comfort") {
  test::dice dice{1};
  auto refused = 0; // then the plan before is kept
  for (auto i = 0; i < 300; ++i) {
    const auto v = dice.between(1, 14);
    auto task = constraints_at(v);
    task.stop_m = v * v / 4 + v * 1.5 + dice.between(1, 20);
    CAPTURE(v);
    CAPTURE(task.stop_m);
    auto here = town_street();
    // The horizon is 6 s: drive on until it rests.
    auto stop = task.stop_m;
    for (auto t = 0.0; t < 60 && task.speed_mps > 0; t += 0.5) {
      const auto r = here.plan(task, task.stop_m);
      REQUIRE(!r.emergency);
      if (here.motion().empty()) {
        ++refused;
        break;
      }
      check_whole(here.motion(), task);
      CHECK(least_accel(here.motion()) > -1.02 * style.firm_decel_mps2());
      CHECK(worst_jerk(here.motion()) < 1.02 * style.max_jerk_mps3);
      for (const auto& x : here.motion())
        REQUIRE(x.s_m < stop - 0.1);
      REQUIRE(here.motion().size() > 5);
      const auto& then = here.motion()[5];
      stop -= then.s_m;
      task.stop_m = stop;
      task.speed_mps = then.speed_mps;
      task.accel_mps2 = then.accel_mps2;
    }
    if (here.motion().empty())
      continue;
    CHECK(task.speed_mps == 0);
    CHECK(stop > 0.1);
    CHECK(stop < 0.8);
  }
  CHECK(refused <= 6); // of 300 drives
}

TEST_CASE("where comfort is not enough it is an emergency, says so, and "
          "stops") {
  test::dice dice{2};
  for (auto i = 0; i < 300; ++i) {
    const auto v = dice.between(2, 20);
    auto task = constraints_at(v);
    // Between what 2.7 and 4.8 m/s² need, and some for brakes to build up.
    task.stop_m = v * v / 2 / dice.between(2.7, 4.8) + 0.35 * v + 0.15;
    CAPTURE(v);
    CAPTURE(task.stop_m);
    auto here = town_street(20);
    const auto needed = v * v / 2 / (task.stop_m - 0.15);
    auto stop = task.stop_m;
    for (auto t = 0.0; t < 20 && task.speed_mps > 0; t += style.step_s) {
      auto r = here.plan(task);
      if (here.motion().empty())
        r = here.planner.brake_only(task);
      check_whole(here.motion(), task);
      if (t == 0 && needed > 1.05 * style.firm_decel_mps2()) {
        CHECK(r.emergency);
        CHECK(r.how == speed_mode::brakes);
      }
      CHECK(least_accel(here.motion()) >= -style.max_decel_mps2 - 1e-9);
      const auto& then = here.motion()[1];
      stop -= then.s_m;
      task.stop_m = stop;
      task.speed_mps = then.speed_mps;
      task.accel_mps2 = then.accel_mps2;
    }
    CHECK(task.speed_mps == 0);
    CHECK(stop > 0);
  }
}

TEST_CASE("behind a car that keeps its speed or brakes as cars do, the gap "
          "stays, and nobody calls it an emergency") {
  test::dice dice{3};
  auto failed = 0;
  for (auto i = 0; i < 300; ++i) {
    const auto v = dice.between(2, 14);
    auto task = constraints_at(v);
    const leader lead{std::max(0.0, v + dice.between(-2, 2)),
                      std::min(0.0, dice.between(-1.5, 0.5))};
    task.ahead = {style.standstill_gap_m + style.time_gap_s * v
                      + dice.between(0, 15),
                  lead};
    CAPTURE(v);
    CAPTURE(lead.speed_mps);
    CAPTURE(lead.accel_mps2);
    CAPTURE(task.ahead->touch_m);
    auto here = town_street();
    const auto r = here.plan(task);
    CHECK(!r.emergency);
    if (here.motion().empty()) {
      ++failed; // whoever drifts to rest within the horizon is hard to follow
      continue;
    }
    check_whole(here.motion(), task);
    CHECK(is_clear(here.motion(), style.step_s, task));
    CHECK(least_accel(here.motion()) > -1.02 * style.firm_decel_mps2());
    for (std::size_t k = 0; k < here.motion().size(); ++k) {
      const auto t = style.step_s * static_cast<double>(k);
      REQUIRE(here.motion()[k].s_m < task.ahead->at(t) - 1.5);
    }
  }
  CHECK(failed < 10);
}

TEST_CASE("a standing car without way to go stands, with a little it moves "
          "up, with more it drives") {
  auto here = town_street();
  auto task = constraints_at(0);
  for (const auto& [stop_m, how] :
       {std::pair{-2.0, speed_mode::stands},
        {0.1, speed_mode::stands},
        {0.6, speed_mode::stands},
        {2.0, speed_mode::moves_up},
        {4.0, speed_mode::moves_up},
        {12.0, speed_mode::optimal},
        {speed_constraints::never, speed_mode::optimal}}) {
    task.stop_m = stop_m;
    CAPTURE(stop_m);
    const auto r = here.plan(task);
    CHECK(r.how == how);
    CHECK(!r.emergency);
    check_whole(here.motion(), task);
    if (how == speed_mode::stands)
      CHECK(here.motion().back().s_m == 0);
    else
      CHECK(here.motion().back().s_m > 0.5);
    CHECK(here.motion().back().s_m < std::max(stop_m, 1e-9));
  }
}

TEST_CASE("who moves up behind another stops before a place that is not open") {
  auto here = town_street();
  auto task = constraints_at(0);
  task.stop_m = 4;
  std::vector<speed_constraints::window> windows{{2, 8}};
  task.windows = windows;
  REQUIRE(!here.plan(task).emergency);
  CHECK(here.motion().back().s_m > 1);
  CHECK(here.motion().back().s_m < 2.001);
  // Nor does it come to rest on one that it has to have left.
  windows[0] = {6, -speed_constraints::never, 9};
  here.plan(task);
  CHECK(here.motion().empty());
}

TEST_CASE("a place that opens later is not passed before, one that closes is "
          "passed in time") {
  test::dice dice{4};
  for (auto i = 0; i < 200; ++i) {
    const auto v = dice.between(6, 13);
    const auto place = dice.between(35, 60);
    auto here = town_street();
    auto task = constraints_at(v);
    here.plan(task);
    const auto free_s = when_s(here.motion(), place);
    if (free_s > 5)
      continue;
    const std::array later{speed_constraints::window{place, free_s + 0.5,
                                                     speed_constraints::never}};
    task.windows = later;
    CAPTURE(v);
    CAPTURE(place);
    here.planner.forget();
    auto r = here.plan(task);
    if (!here.motion().empty() && !r.emergency
        && ocp::publishable(r.report.status))
      CHECK(when_s(here.motion(), place) > later[0].earliest_s - 0.05);
    const std::array sooner{speed_constraints::window{
        place, -speed_constraints::never, free_s + 0.3}};
    task.windows = sooner;
    here.planner.forget();
    r = here.plan(task);
    REQUIRE(!here.motion().empty());
    CHECK(ocp::publishable(r.report.status));
    CHECK(when_s(here.motion(), place) < sooner[0].latest_s + 0.05);
  }
}

TEST_CASE("dearer plans are those that lose time or comfort") {
  auto here = town_street();
  auto task = constraints_at(10);
  const auto free = here.plan(task).price;
  here.planner.forget();
  task.stop_m = 45;
  const auto stops = here.plan(task).price;
  here.planner.forget();
  task.stop_m = 36;
  const auto stops_hard = here.plan(task).price;
  CHECK(free < stops);
  CHECK(stops < stops_hard);
}

TEST_CASE("a planner that forgets plans as a new one") {
  auto here = town_street(), fresh = town_street();
  here.plan(constraints_at(12));
  here.planner.forget();
  auto task = constraints_at(9, 0.3);
  task.stop_m = 60;
  here.plan(task);
  fresh.plan(task);
  REQUIRE(here.motion().size() == fresh.motion().size());
  for (std::size_t i = 0; i < here.motion().size(); ++i) {
    CHECK(here.motion()[i].s_m == fresh.motion()[i].s_m);
    CHECK(here.motion()[i].accel_mps2 == fresh.motion()[i].accel_mps2);
  }
}

TEST_CASE("the last resort comes to rest, firm enough and no firmer than the "
          "car can") {
  test::dice dice{5};
  for (auto i = 0; i < 200; ++i) {
    auto task = constraints_at(dice.between(0, 20), dice.between(-2, 1.5));
    if (i % 2 == 0)
      task.stop_m = dice.between(-5, 100);
    auto here = town_street(20);
    const auto r = here.planner.brake_only(task);
    CHECK(r.emergency);
    check_whole(here.motion(), task);
    CHECK(here.motion().size() == 61);
    CHECK(least_accel(here.motion()) >= -style.max_decel_mps2 - 1e-9);
    CHECK(here.motion().back().speed_mps < 6);
  }
}

TEST_CASE("a motion is clear when it keeps off the line, the car ahead and "
          "the windows") {
  speed_profile steady;
  for (auto i = 0; i <= 60; ++i)
    steady.push_back({0.1 * i * 10, 10, 0});
  const auto clear = [&](const speed_constraints& task) {
    return is_clear(steady, 0.1, task);
  };
  auto task = constraints_at(10);
  CHECK(clear(task));
  task.stop_m = 61;
  CHECK(clear(task));
  task.stop_m = 59;
  CHECK(!clear(task));
  task = constraints_at(10);
  task.ahead = {5, {10, 0}};
  CHECK(clear(task));
  task.ahead = {5, {8, 0}};
  CHECK(!clear(task));
  task.ahead = {40, {10, -3}};
  CHECK(!clear(task));
  task = constraints_at(10);
  std::array window{speed_constraints::window{30, 2.5, 3.5}};
  task.windows = window;
  CHECK(clear(task));
  window[0] = {30, 3.6, speed_constraints::never};
  CHECK(!clear(task));
  window[0] = {30, -speed_constraints::never, 2.5};
  CHECK(!clear(task));
}
