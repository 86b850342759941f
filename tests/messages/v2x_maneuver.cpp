// Tests of plans on the wire: what is written down is the plan, what is read
// is the plan again, and strangers' numbers do no harm.
#include "messages/v2x/mcm/maneuver.hpp"
#include "planners/scene/lane_motion.hpp"
#include "planners/trajectory/safe_stop.hpp"
#include "tests/planners/test_drive.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/map_file.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::planners;
using namespace sofof::world;
using sofof::test::dice;
using sofof::test::test_drive;
using namespace std::chrono_literals;

namespace {

// What issue and rounding allow.
constexpr double waypoint_m = 0.01, waypoint_mps = 0.01;
constexpr double between_m = 0.03;

const std::vector<speed_zone> town{{0, 13.9}, {120, 8.3}, {200, 13.9}};

const geo_frame& earth() {
  static const geo_frame frame;
  return frame;
}

/// What went over the wire and came out.
struct delivery {
  std::vector<maneuver_waypoint> waypoints;
  trajectory plan;
  maneuver_fault fault = maneuver_fault::none;
};

void deliver(const trajectory& plan, const route& way, const trajectory* before,
             delivery& x) {
  const auto place =
      place_maneuver(earth(), plan.points[0].at, plan.start - 700us);
  REQUIRE(to_waypoints(plan, place.frame, x.waypoints));
  const auto guess_m = plan.points[0].s_m + 5;
  x.fault =
      to_trajectory(x.waypoints, place.frame, way, guess_m, before, x.plan);
}

/// How far what came out is from what went in.
struct errors {
  double waypoint_m = 0, waypoint_mps = 0, between_m = 0;
  double curvature_1pm = 0; // at 5 m/s and more, where it is steered by next
  double accel_mps2 = 0;    // where it is driven by next

  void add(const trajectory& plan, const delivery& x) {
    const auto first =
        x.plan.start - std::chrono::milliseconds{x.waypoints.front().t_ms};
    for (const auto& w : x.waypoints) {
      const auto t = first + std::chrono::milliseconds{w.t_ms};
      if (t > plan.end()) // by less than a millisecond
        continue;
      const auto a = plan.at(t), b = x.plan.at(t);
      waypoint_m = std::max(waypoint_m, distance_m(a.at, b.at));
      waypoint_mps =
          std::max(waypoint_mps, std::abs(a.speed_mps - b.speed_mps));
    }
    const auto end = std::min(plan.end(), x.plan.end());
    for (auto t = x.plan.start; t < end; t += 23ms) {
      const auto a = plan.at(t), b = x.plan.at(t);
      between_m = std::max(between_m, distance_m(a.at, b.at));
      const auto soon = t - plan.start > 50ms && t - plan.start < 600ms;
      if (soon && a.speed_mps > 5)
        curvature_1pm = std::max(curvature_1pm,
                                 std::abs(a.curvature_1pm - b.curvature_1pm));
    }
    for (auto t = x.plan.start + 50ms; t < x.plan.start + 400ms; t += 23ms) {
      const auto a = plan.at(t), b = x.plan.at(t);
      if (a.speed_mps > 1)
        accel_mps2 =
            std::max(accel_mps2, std::abs(a.accel_mps2 - b.accel_mps2));
    }
  }

  void check() const {
    CHECK(waypoint_m < ::waypoint_m);
    CHECK(waypoint_mps < ::waypoint_mps);
    CHECK(between_m < ::between_m);
  }
};

/// Drives, and sends every plan; now and then somebody is in the way.
errors send_all_plans(test_drive drive, const route_ptr& way, double seconds,
                      std::uint64_t seed) {
  errors worst;
  delivery now, before;
  dice d{seed};
  auto stops = 0;
  for (auto t = 0.0; t < seconds; t += 0.05) {
    if (stops == 0 && d.between(0, 1) < 0.004) {
      drive.others.stop_at_m = drive.front_m() + d.between(12, 60);
      stops = 200;
    } else if (stops > 0 && --stops == 0) {
      drive.others.stop_at_m.reset();
    }
    drive.cycle();
    // Planning takes time, of no whole number of milliseconds.
    auto plan = drive.plan;
    plan.start += duration{static_cast<std::int64_t>(d.between(0, 1e6))};
    std::swap(now, before);
    deliver(plan, *way, before.plan.empty() ? nullptr : &before.plan, now);
    REQUIRE(now.fault == maneuver_fault::none);
    REQUIRE(now.plan.is_sound());
    worst.add(plan, now);
  }
  return worst;
}

} // namespace

TEST_CASE("every plan of a drive comes out as it went in") {
  for (const auto& way : {test::oval(town), test::s_curve(town)}) {
    auto x = send_all_plans({way, 5, 0, test::optimiser(way)}, way, 60, 1);
    x.check();
    CHECK(x.curvature_1pm < 0.006); // its corners have a radius of 10 m
    CHECK(x.accel_mps2 < 0.3);
    x = send_all_plans({way, 5, 0, test::follower(way)}, way, 60, 2);
    x.check();
  }
}

TEST_CASE("so it does on the streets of Ulm-Lehr") {
  const auto map =
      test::read_map(SOFOF_SOURCE_DIR "/config/maps/ulm_lehr.toml");
  std::uint64_t seed = 3;
  for (const auto& way : map.routes) {
    CAPTURE(way->name());
    const auto x =
        send_all_plans({way, 5, 0, test::optimiser(way)}, way, 40, seed++);
    x.check();
    CHECK(x.curvature_1pm < 0.003);
  }
}

TEST_CASE("braking to rest from any motion comes out, and rests") {
  const auto way = test::oval(town);
  dice d{4};
  delivery x;
  errors worst;
  for (int i = 0; i < 1000; ++i) {
    planning_input from;
    from.s_m = d.between(-20, way->length_m() + 20); // over the seam, too
    from.d_m = d.between(-0.2, 0.2);
    from.heading_error_rad = d.between(-0.02, 0.02);
    from.speed_mps = d.between(0, 1) < 0.1 ? 0 : d.between(0.05, 9);
    from.accel_mps2 = d.between(-1.5, 1.5);
    const time_point now{std::chrono::microseconds{i * 50017}};
    from.at = now;
    const auto plan = safe_stop(*way, now, from, d.between(2, 6));
    deliver(plan, *way, nullptr, x);
    REQUIRE(x.fault == maneuver_fault::none);
    REQUIRE(x.plan.is_sound());
    const auto& last = x.plan.points.back();
    REQUIRE(last.speed_mps == 0);
    REQUIRE(last.accel_mps2 == 0);
    for (std::size_t k = 1; k < x.plan.points.size(); ++k)
      REQUIRE(x.plan.points[k].s_m >= x.plan.points[k - 1].s_m);
    worst.add(plan, x);
  }
  worst.check();
}

TEST_CASE("a car that stands is one place, all the time") {
  const auto way = test::straight(200, town);
  const auto plan =
      safe_stop(*way, time_point{1234567ns}, {{}, 50, 0.1, 0, 0, 0, 0, {}});
  delivery x;
  deliver(plan, *way, nullptr, x);
  REQUIRE(x.fault == maneuver_fault::none);
  CHECK(x.waypoints.size() == 2);
  for (const auto& p : x.plan.points) {
    CHECK(p.speed_mps == 0);
    CHECK(distance_m(p.at, plan.points[0].at) < waypoint_m);
    CHECK(p.at == x.plan.points[0].at);
  }
}

TEST_CASE("laps are kept") {
  const auto way = test::oval(town);
  trajectory plan;
  for (int i = 0; i <= 60; ++i) {
    const auto s = 3 * way->length_m() - 20 + i * 0.8;
    const auto p = way->path().at(s);
    plan.points.push_back(
        {i * 0.1, s, p.at, p.heading_rad, p.curvature_1pm, 8, 0});
  }
  delivery x;
  deliver(plan, *way, nullptr, x);
  REQUIRE(x.fault == maneuver_fault::none);
  CHECK(x.plan.points.back().s_m
        == doctest::Approx(plan.points.back().s_m).epsilon(1e-5));
  CHECK(x.plan.points.back().heading_rad
        == doctest::Approx(plan.points.back().heading_rad).epsilon(1e-2));
}

TEST_CASE("waypoints begin with the plan, rise, and are no more than fit") {
  const auto way = test::straight(3000, town);
  for (const auto length_s : {0.002, 0.1, 0.7, 6.0, 30.0, 64.0}) {
    trajectory plan;
    plan.start = time_point{777999999ns};
    const auto steps = std::max(1.0, std::round(length_s / 0.1));
    for (auto i = 0.0; i <= steps; ++i) {
      const auto t = i * length_s / steps;
      // The jerk jumps all the time.
      const auto accel = static_cast<int>(i) % 2 == 0 ? 0.0 : 1.5;
      plan.points.push_back({t, 5 + 10 * t, {5 + 10 * t, 0}, 0, 0, 10, accel});
    }
    delivery x;
    deliver(plan, *way, nullptr, x);
    REQUIRE(x.fault == maneuver_fault::none);
    CHECK(x.waypoints.size() >= 2);
    CHECK(x.waypoints.size() <= most_waypoints);
    CHECK(x.plan.start >= plan.start);
    CHECK(x.plan.start - plan.start < 1ms);
    CHECK(std::abs(to_seconds(x.plan.end() - plan.end())) < 1.5e-3);
    for (std::size_t i = 1; i < x.waypoints.size(); ++i)
      CHECK(x.waypoints[i].t_ms > x.waypoints[i - 1].t_ms);
  }
}

TEST_CASE("a vehicle's own plan comes out of a planned trajectory") {
  const auto way = test::s_curve(town);
  test_drive drive{way, 5, 0, test::optimiser(way)};
  planned_points sent;
  trajectory seen;
  for (auto t = 0.0; t < 40; t += 0.05) {
    drive.cycle();
    const auto& plan = drive.plan;
    const auto place = place_maneuver(earth(), drive.car.at, plan.start);
    REQUIRE(to_planned_points(plan, place.frame, sent));
    REQUIRE(sent.points.size() <= most_waypoints);
    REQUIRE(to_trajectory(sent, place.frame, *way, plan.points[0].s_m, nullptr,
                          seen)
            == maneuver_fault::none);
    for (auto at = seen.start; at < seen.end(); at += 50ms) {
      REQUIRE(distance_m(seen.at(at).at, plan.at(at).at) < between_m);
      REQUIRE(std::abs(seen.at(at).speed_mps - plan.at(at).speed_mps) < 0.03);
    }
  }
}

TEST_CASE("what cannot be written down is refused") {
  const auto place = place_maneuver(earth(), {0, 0}, time_point{});
  std::vector<maneuver_waypoint> out(3);
  planned_points points;
  const auto refused = [&](const trajectory& plan) {
    const auto no = !to_waypoints(plan, place.frame, out)
                    && !to_planned_points(plan, place.frame, points);
    return no && out.empty() && points.points.empty();
  };
  trajectory plan;
  CHECK(refused(plan));
  plan.points = {{0, 0, {0, 0}, 0, 0, 1, 0}, {0.1, 0, {0.1, 0}, 0, 0, 1, 0}};
  CHECK(!refused(plan));
  plan.points[1].at.x_m = 1400;
  CHECK(refused(plan));
  plan.points[1].at.x_m = 9e8;
  CHECK(refused(plan));
  plan.points[1].at.x_m = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused(plan));
  plan.points[1].at.x_m = 0.1;
  plan.points[0].speed_mps = 190;
  CHECK(refused(plan));
  plan.points[0].speed_mps = 1;
  plan.start = time_point{66s};
  CHECK(refused(plan));
  plan.start = time_point{-1s};
  CHECK(refused(plan));
}

TEST_CASE("what is no plan is refused, and with a reason") {
  const auto way = test::straight(200, town);
  const auto place = place_maneuver(earth(), {50, 0}, time_point{});
  trajectory out;
  using list = std::vector<maneuver_waypoint>;
  const auto fault = [&](const list& x) {
    return to_trajectory(x, place.frame, *way, 50, nullptr, out);
  };
  CHECK(fault({{0, 0, 0, 500}, {100, 0, 200, 500}}) == maneuver_fault::none);
  CHECK(out.is_sound());
  CHECK(fault({{0, 0, 0, 500}}) == maneuver_fault::wrong_count);
  CHECK(fault(list(129)) == maneuver_fault::wrong_count);
  CHECK(fault({{0, 0, 5, 500}, {100, 0, 5, 500}})
        == maneuver_fault::times_not_rising);
  CHECK(fault({{0, 0, 0, 500}, {100, 0, 65536, 500}})
        == maneuver_fault::out_of_range);
  CHECK(fault({{0, 0, 0, 500}, {100, 0, 200, 16383}})
        == maneuver_fault::out_of_range);
  CHECK(fault({{0, 0, 0, 500}, {-131072, 0, 200, 500}})
        == maneuver_fault::out_of_range);
  CHECK(fault({{0, 1100, 0, 500}, {100, 1100, 200, 500}})
        == maneuver_fault::off_route);
  CHECK(!to_string(maneuver_fault::off_route).empty());
}

TEST_CASE("no numbers do harm") {
  const auto oval = test::oval(town);
  const auto street = test::straight(200, town);
  const auto place = place_maneuver(earth(), {50, 0}, time_point{});
  dice d{5};
  trajectory out, before;
  auto accepted = 0;
  const auto whole = [&d](double low, double high) {
    return static_cast<std::int32_t>(d.between(low, high));
  };
  for (int i = 0; i < 20000; ++i) {
    const auto n = static_cast<std::size_t>(d.between(0, 131));
    std::vector<maneuver_waypoint> all(n);
    planned_points points{whole(-5, 65540), whole(0, 258), {}};
    const auto wild = d.between(0, 1) < 0.2;
    const auto reach = wild ? 2e9 : d.between(0, 1000);
    const auto fast = d.between(0, 1) < 0.5 ? 16383 : d.between(0, 500);
    auto t = whole(0, 100);
    for (auto& x : all) {
      x = {whole(-reach, reach), whole(-reach, reach), t,
           whole(wild ? -3 : 0, fast)};
      t += whole(wild ? -1 : 1, 1000);
      points.points.push_back({x.x_cm, x.y_cm, x.speed_cmps, whole(-1, 3603)});
    }
    const auto& way = d.between(0, 1) < 0.5 ? *oval : *street;
    const auto guess_m = d.between(-1e6, 1e6) * (i % 2);
    for (auto j = 0; j < 2; ++j) {
      const auto fault =
          j == 0
              ? to_trajectory(all, place.frame, way, guess_m, &before, out)
              : to_trajectory(points, place.frame, way, guess_m, &before, out);
      if (fault != maneuver_fault::none)
        continue;
      ++accepted;
      REQUIRE(out.is_sound());
      std::swap(out, before);
    }
  }
  CHECK(accepted > 10); // few are what a car can do
}
