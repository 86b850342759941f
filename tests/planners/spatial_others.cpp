// Driving in closed loop with the optimiser: past those who stand in the lane
// and those who cross it.
#include "tests/planners/random_road.hpp"
#include "tests/planners/usual_drive.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using doctest::Approx;
using test::optimal;
using test::style;
using test::test_drive;

namespace {

route_ptr wide_street(double half_width_m) {
  std::vector<lane> lanes(1);
  lanes[0].name = "street";
  lanes[0].half_width_m = half_width_m;
  test::append_line(lanes[0].centre, {0, 0}, {600, 0});
  lanes[0].centre.push_back({600, 0});
  lanes[0].limits = {{0, 13.9}};
  return std::make_shared<const route>(
      "wide", lanes, std::vector<std::size_t>{0}, false, world::lane_index{});
}

/// On a road due east.
bool touches(const test_drive& drive, const lane_obstacle& body, double t_s,
             double gap_m = 0) {
  const auto moved = body.speed_mps * t_s;
  const oriented_box other{
      {(body.from_m + body.to_m) / 2 + moved, (body.low_m + body.high_m) / 2},
      0,
      body.to_m - body.from_m,
      body.high_m - body.low_m + 2 * gap_m};
  return overlap(sofof::world::body(drive.car, drive.ability), other);
}

/// What happened on the way past a body.
struct passage {
  double left_m = 0, right_m = 0; ///< Largest offsets.
  double slowest_mps = 100;
  int changes = 0; ///< Of the chosen sides.
};

passage pass(test_drive& drive, const lane_obstacle& body, double seconds,
             double sight_m = 100) {
  passage p;
  auto choice = std::uint32_t{0};
  auto seen_before = false;
  for (auto t = 0.0; t < seconds; t += 0.05) {
    auto here = body;
    here.from_m += body.speed_mps * t;
    here.to_m += body.speed_mps * t;
    const auto seen = drive.rear_m() < here.to_m + 1
                      && here.from_m - drive.front_m() < sight_m;
    drive.others.beside.clear();
    if (seen)
      drive.others.beside.push_back(here);
    drive.cycle();
    REQUIRE(!touches(drive, body, to_seconds(drive.now), 0.1));
    const auto sides = drive.report.choice & 0xff;
    if (seen && seen_before)
      p.changes += sides != choice ? 1 : 0;
    choice = sides;
    seen_before = seen;
    p.left_m = std::max(p.left_m, drive.car.at.y_m);
    p.right_m = std::min(p.right_m, drive.car.at.y_m);
    p.slowest_mps = std::min(p.slowest_mps, drive.car.speed_mps);
  }
  return p;
}

void check_comfort_among_others(const test_drive& drive) {
  CHECK(drive.emergencies < 10); // a swerve may be too fast for a moment
  CHECK(drive.worst.over_limit < 1.01);
  CHECK(drive.worst.min_accel_mps2 > -2.6);
  CHECK(drive.worst.plan_gap_m < 0.002);
}

/// Somebody who crosses, in absolute time.
struct crosser {
  double from_m, to_m;
  double enter_s, leave_s;
  bool goes_first = true;
};

/// What happened at the crossings.
struct crossing_drive {
  int changes = 0; ///< Of who is first while the same people were there;
                   ///< to wait for all is to be last.
  double slowest_mps = 100;
  bool met = false; ///< Own car and somebody else were there at once.
};

crossing_drive cross(test_drive& drive, const std::vector<crosser>& all,
                     double seconds) {
  crossing_drive result;
  std::uint32_t choice = 0;
  std::size_t known = 0;
  for (auto t = 0.0; t < seconds; t += 0.05) {
    auto& users = drive.others.crossings;
    users.clear();
    for (std::uint32_t body = 0; const auto& c : all) {
      ++body;
      if (c.leave_s <= t || drive.rear_m() >= c.to_m)
        continue;
      auto& user = users.emplace_back();
      user.from_m = c.from_m;
      user.to_m = c.to_m;
      user.enter_s = std::max(0.0, c.enter_s - t);
      user.leave_s = c.leave_s - t;
      user.goes_first = c.goes_first;
      user.body = body;
    }
    drive.cycle();
    const auto order = drive.report.choice >> 8 & 0xf;
    if (users.size() == known && known > 0)
      result.changes += order != choice ? 1 : 0;
    known = users.size();
    choice = order;
    result.slowest_mps = std::min(result.slowest_mps, drive.car.speed_mps);
    const auto now = to_seconds(drive.now);
    for (const auto& c : all)
      result.met |= now >= c.enter_s && now <= c.leave_s
                    && drive.front_m() > c.from_m && drive.rear_m() < c.to_m;
  }
  return result;
}

} // namespace

TEST_CASE("a body in the lane is passed on the side with room, without "
          "touching it, without stopping") {
  for (const auto sight_m : {100.0, 45.0})
    for (const auto edge : {-1.5, -1.1, -0.85})
      for (const auto left : {true, false}) {
        CAPTURE(sight_m);
        CAPTURE(edge);
        CAPTURE(left);
        const lane_obstacle body{180, 185, left ? -2.3 : -edge,
                                 left ? edge : 2.3, 0};
        auto drive = optimal(test::straight(600, {{0, 13.9}}), 10, 13.9);
        const auto p = pass(drive, body, 35, sight_m);
        CHECK(drive.s_m() > 350);
        check_comfort_among_others(drive);
        CHECK(drive.worst.plan_jerk_mps3 < 1.02 * style.max_jerk_mps3);
        CHECK(drive.worst.plan_lateral_mps2
              < 1.02 * style.max_lateral_accel_mps2);
        CHECK(p.changes == 0);
        CHECK(p.slowest_mps > 8);
        CHECK(drive.worst.lateral_m < 0.8);
        CHECK((left ? p.right_m > -0.3 : p.left_m < 0.3));
        CHECK(std::abs(drive.car.at.y_m) < 0.05); // back in the middle
      }
}

TEST_CASE("a body in the middle of a wide street is passed on one side, and "
          "the choice stays") {
  for (const auto middle : {-0.6, -0.2, 0.0, 0.2, 0.6}) {
    CAPTURE(middle);
    const lane_obstacle body{180, 184, middle - 0.4, middle + 0.4, 0};
    auto drive = optimal(wide_street(4), 10, 12);
    const auto p = pass(drive, body, 35);
    CHECK(drive.s_m() > 350);
    check_comfort_among_others(drive);
    CHECK(p.changes <= 1);
    if (std::abs(middle) > 0.5)
      CHECK((middle > 0 ? p.right_m < -0.5 : p.left_m > 0.5));
  }
}

TEST_CASE("bodies on both sides, one after the other, are passed in turn") {
  auto drive = optimal(test::straight(600, {{0, 8.3}}), 10, 8.3);
  const std::vector<lane_obstacle> all{{120, 124, -2.3, -1.0, 0},
                                       {165, 169, 1.0, 2.3, 0},
                                       {210, 214, -2.3, -1.0, 0}};
  for (auto t = 0.0; t < 50; t += 0.05) {
    drive.others.beside.clear();
    for (const auto& body : all)
      if (drive.rear_m() < body.to_m)
        drive.others.beside.push_back(body);
    drive.cycle();
    for (const auto& body : all)
      REQUIRE(!touches(drive, body, 0, 0.1));
  }
  CHECK(drive.s_m() > 300);
  check_comfort_among_others(drive);
}

TEST_CASE("who comes towards the car or drives slowly at the side is passed, "
          "too") {
  for (const auto speed : {-8.0, -3.0, 1.0, 3.0}) {
    CAPTURE(speed);
    const lane_obstacle body{200, 204, 0.95, 2.5, speed};
    auto drive = optimal(test::straight(900, {{0, 13.9}}), 10, 13.9);
    const auto p = pass(drive, body, 45);
    CHECK(drive.s_m() > 450);
    CHECK(drive.emergencies < 10);
    CHECK(p.changes <= 2); // whether it is met at all
  }
}

TEST_CASE("who crosses first is let go, or passed before when there is time, "
          "and is never met") {
  test::dice dice{1};
  auto before = 0, after = 0;
  for (auto i = 0; i < 24; ++i) {
    const auto speed = dice.between(6, 13.9);
    const auto from = dice.between(110, 150);
    const auto enter = dice.between(2, 20), lasts = dice.between(1, 5);
    CAPTURE(i);
    CAPTURE(speed);
    CAPTURE(from);
    CAPTURE(enter);
    CAPTURE(lasts);
    auto drive = optimal(test::straight(900, {{0, 13.9}}), 10, speed);
    const auto x = cross(drive, {{from, from + 4, enter, enter + lasts}}, 45);
    CHECK(!x.met);
    check_comfort_among_others(drive);
    CHECK(drive.s_m() > 250);
    CHECK(x.changes <= 3); // waiting counts
    (x.slowest_mps > 0.95 * speed ? before : after) += 1;
  }
  CHECK(before > 2);
  CHECK(after > 2);
}

TEST_CASE("who gives way costs no time") {
  auto drive = optimal(test::straight(900, {{0, 13.9}}), 10, 13.9);
  auto slowest = 13.9;
  for (auto t = 0.0; t < 20; t += 0.05) {
    drive.others.crossings.clear();
    if (drive.rear_m() < 114) // he comes, sees, and stays
      drive.others.crossings.push_back(
          {110, 114, std::max(1.0, 5 - t), std::max(4.0, 8 - t), false});
    drive.cycle();
    slowest = std::min(slowest, drive.car.speed_mps);
  }
  CHECK(slowest > 13.5);
  check_comfort_among_others(drive);
}

TEST_CASE("a place that stays taken for long is waited for, at its line, and "
          "driven on from") {
  auto drive = optimal(test::straight(900, {{0, 13.9}}), 10, 13.9);
  auto x = cross(drive, {{150, 154, 2, 40}}, 38);
  CHECK(!x.met);
  CHECK(drive.car.speed_mps == 0);
  CHECK(drive.front_m() < 150);
  CHECK(drive.front_m() > 148);
  check_comfort_among_others(drive);
  CHECK(x.changes <= 2);
  drive.others.crossings.clear();
  drive.drive(15);
  CHECK(drive.s_m() > 180);
  check_comfort_among_others(drive);
}

TEST_CASE("somebody who stands on the crossing is waited for until he goes") {
  constexpr auto never = std::numeric_limits<double>::infinity();
  auto drive = optimal(test::straight(900, {{0, 13.9}}), 10, 10);
  const auto x = cross(drive, {{120, 124, 0, never}}, 40);
  CHECK(!x.met);
  CHECK(drive.car.speed_mps == 0);
  CHECK(drive.front_m() < 120);
  CHECK(drive.front_m() > 118);
  check_comfort_among_others(drive);
}

TEST_CASE("a car waits before crossings rather than come to rest among them") {
  // The first place of two is free soon, the second one is not.
  const std::vector<crosser> all{{120, 126, 0, 1}, {130, 136, 3, 60}};
  const auto drive_to_them = [&](double seconds) {
    auto drive = optimal(test::straight(900, {{0, 13.9}}), 90, 3);
    drive.others.keep_free = {{120, 136}};
    cross(drive, all, seconds);
    return drive;
  };
  auto waiting = drive_to_them(25);
  CHECK(waiting.car.speed_mps == 0);
  CHECK(waiting.front_m() < 120);
  CHECK(waiting.front_m() > 118);
  check_comfort_among_others(waiting);
}

TEST_CASE("who has stood before crossings for long moves up among them") {
  const auto comes_to_m = [](bool is_impatient) {
    auto drive = optimal(test::straight(900, {{0, 13.9}}), 90, 3);
    drive.others.keep_free = {{120, 136}};
    cross(drive, {{120, 126, 0, 25}}, 20);
    REQUIRE(drive.front_m() < 120);
    drive.others.is_impatient = is_impatient;
    CHECK(!cross(drive, {{130, 136, 0, 20}}, 12).met);
    return drive.front_m();
  };
  CHECK(comes_to_m(false) < 121);
  CHECK(comes_to_m(true) > 123);
}

TEST_CASE("several who cross at several places are never met") {
  test::dice dice{2};
  for (auto i = 0; i < 12; ++i) {
    CAPTURE(i);
    std::vector<crosser> all;
    for (const auto from : {120.0, 160.0, 164.0})
      for (auto t = dice.between(3, 8); t < 25; t += dice.between(4, 12))
        all.push_back({from, from + 4, t, t + dice.between(1, 3)});
    spatial_params params;
    params.candidates = 1 + i % 4;
    auto drive = optimal(test::straight(900, {{0, 13.9}}), 10,
                         dice.between(6, 13.9), params);
    const auto x = cross(drive, all, 70);
    CHECK(!x.met);
    CHECK(drive.s_m() > 250);
    CHECK(drive.worst.min_accel_mps2 > -3.5);
  }
}
