// Driving in closed loop: planner, controller and car together.
#include "tests/planners/usual_drive.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;
using test::test_drive;
using test::town;

namespace {

constexpr auto comfortable_jerk_mps3 = 1.7; // the plan's 1.5, and control

void check_lane_comfort(const test_drive& drive) {
  CHECK(drive.worst.lateral_m < 0.05);
  CHECK(drive.worst.over_limit < 1.01);
  CHECK(drive.worst.min_accel_mps2 > -2.6);
  CHECK(drive.worst.plan_jerk_mps3 < 1.501);
  CHECK(drive.worst.jerk_mps3 < comfortable_jerk_mps3);
  CHECK(drive.worst.plan_gap_m < 0.002);
}

} // namespace

TEST_CASE("two laps keep the lane, the limits and the comfort") {
  const auto way = test::oval(town);
  test_drive drive{way, 5};
  drive.drive(180);
  CHECK(drive.s_m() > 2 * way->length_m());
  check_lane_comfort(drive);
  CHECK(drive.worst.plan_change_m < 0.05);
}

TEST_CASE("inputs that are 0.4 s old drive as smoothly") {
  test_drive drive{test::oval(town), 5};
  drive.staleness = from_seconds(0.4);
  drive.drive(90);
  CHECK(drive.s_m() > 700);
  check_lane_comfort(drive);
  CHECK(drive.worst.plan_change_m < 0.05);
}

TEST_CASE("an S-curve is driven, and an open route ends at rest") {
  const auto way = test::s_curve({{0, 13.9}, {100, 8.3}, {220, 13.9}});
  test_drive drive{way, 0, 10};
  drive.drive(60);
  check_lane_comfort(drive);
  CHECK(drive.car.speed_mps == 0);
  CHECK(drive.front_m() < way->length_m());
  CHECK(drive.front_m() > way->length_m() - 0.6);
}

TEST_CASE("a car stops shortly before a line, stands still, and goes on when "
          "the line opens") {
  test_drive drive{test::straight(600, {{0, 13.9}}), 0, 13.9};
  drive.others.stop_at_m = 150;
  drive.drive(16);
  check_lane_comfort(drive);
  CHECK(drive.front_m() < 150);
  CHECK(drive.front_m() > 149.4);
  const auto standing = drive.car;
  drive.drive(5);
  CHECK(drive.car.at == standing.at);
  CHECK(drive.car.speed_mps == 0);

  drive.others.stop_at_m.reset();
  auto speed = 0.0;
  for (auto i = 0; i < 20 * 8; ++i) {
    drive.cycle();
    REQUIRE(drive.car.speed_mps >= speed - 1e-6);
    speed = drive.car.speed_mps;
  }
  CHECK(speed > 8);
  CHECK(drive.worst.jerk_mps3 < comfortable_jerk_mps3);
}

TEST_CASE("a line that closes late is not passed") {
  test_drive drive{test::straight(600, {{0, 13.9}}), 0, 13.9};
  drive.drive(2);
  const auto line_m = drive.front_m() + 25;
  drive.others.stop_at_m = line_m;
  drive.drive(10);
  CHECK(drive.car.speed_mps == 0);
  CHECK(drive.front_m() < line_m);
  CHECK(drive.worst.min_accel_mps2 < -4); // an emergency
}

TEST_CASE("a standing car does not creep after small openings") {
  test_drive drive{test::straight(600, {{0, 13.9}}), 0, 0};
  drive.others.stop_at_m = drive.front_m() + 0.4;
  drive.drive(5);
  CHECK(drive.s_m() == Approx(0));
  drive.others.stop_at_m.reset();
  drive.others.lead = lead_vehicle{1, drive.front_m() + 3.1, 0, 0};
  drive.drive(5);
  CHECK(drive.s_m() == Approx(0));
}

TEST_CASE("nobody is hit when the car ahead brakes as hard as it can") {
  for (const auto age_s : {0.0, 0.1, 0.4})
    for (const auto speed : {3.0, 8.3, 13.9, 27.8}) {
      CAPTURE(age_s);
      CAPTURE(speed);
      test_drive drive{test::straight(2000, {{0, speed}}), 0, speed};
      drive.staleness = from_seconds(age_s);
      constexpr auto standstill_gap_m = 3.0, time_gap_s = 1.5;
      lead_vehicle lead{
          1, drive.front_m() + standstill_gap_m + time_gap_s * speed, speed, 0};
      for (auto i = 0; i < 20 * 30; ++i) {
        const auto brakes = i >= 20 * 3;
        lead.accel_mps2 = brakes && lead.speed_mps > 0 ? -6 : 0;
        drive.others.lead = lead;
        drive.cycle();
        const auto x = advance({lead.rear_s_m, lead.speed_mps, lead.accel_mps2},
                               lead.accel_mps2, 0.05);
        lead.rear_s_m = x.s_m;
        lead.speed_mps = x.speed_mps;
        REQUIRE(lead.rear_s_m - drive.front_m() > 1.5);
      }
      CHECK(drive.car.speed_mps == 0);
      CHECK(lead.rear_s_m - drive.front_m() < 4);
    }
}

TEST_CASE("a car ahead that stops as cars do is followed in comfort") {
  const auto way = test::straight(900, {{0, 13.9}});
  test_drive ahead{way, 60, 13.9}, behind{way, 30, 13.9};
  ahead.others.stop_at_m = 300;
  for (auto i = 0; i < 20 * 40; ++i) {
    behind.others.lead = ahead.as_lead();
    ahead.cycle();
    behind.cycle();
  }
  CHECK(behind.car.speed_mps == 0);
  CHECK(ahead.rear_m() - behind.front_m() == Approx(3).epsilon(0.1));
  CHECK(behind.worst.min_accel_mps2 > -2.6);
  CHECK(behind.worst.jerk_mps3 < comfortable_jerk_mps3);
}

TEST_CASE("firm braking ahead is answered firmly, but is no emergency") {
  const auto way = test::straight(900, {{0, 13.9}});
  test_drive behind{way, 30, 13.9};
  lead_vehicle lead{1, behind.front_m() + 24, 13.9, 0};
  for (auto t = 0.0; t < 10; t += 0.05) {
    lead.accel_mps2 = -std::clamp(t - 2, 0.0, 3.0); // at 1 m/s³
    lead.speed_mps = std::max(0.0, lead.speed_mps + 0.05 * lead.accel_mps2);
    lead.rear_s_m += 0.05 * lead.speed_mps;
    behind.others.lead = lead;
    behind.cycle();
    REQUIRE(lead.rear_s_m > behind.front_m() + 2.5);
  }
  CHECK(behind.worst.min_accel_mps2 > -4);
  CHECK(behind.worst.plan_jerk_mps3 < 6);
}

TEST_CASE("six cars in a row start, follow and stop without a collision, and "
          "calm the one ahead down") {
  for (const auto age_s : {0.0, 0.4}) {
    CAPTURE(age_s);
    const auto way = test::straight(2000, {{0, 13.9}});
    std::vector<test_drive> row;
    for (auto i = 0; i < 6; ++i) {
      row.emplace_back(way, 60 - 9.0 * i);
      row.back().staleness = from_seconds(age_s);
    }
    const auto drive = [&](double seconds) {
      for (auto t = 0.0; t < seconds; t += 0.05) {
        for (std::size_t i = 1; i < row.size(); ++i)
          row[i].others.lead = row[i - 1].as_lead();
        for (auto& car : row)
          car.cycle();
        for (std::size_t i = 1; i < row.size(); ++i)
          REQUIRE(row[i - 1].rear_m() - row[i].front_m() > 2);
      }
    };
    drive(60);
    for (auto& car : row) {
      CHECK(car.car.speed_mps == Approx(13.9).epsilon(0.05));
      car.worst = {};
    }
    // Somebody cuts in before the first car for a while.
    for (auto i = 0; i < 80; ++i) {
      row[0].others.lead =
          lead_vehicle{9, row[0].front_m() + 8, row[0].car.speed_mps - 1, 0};
      drive(0.05);
    }
    row[0].others.lead.reset();
    drive(40);
    for (std::size_t i = 1; i < row.size(); ++i)
      CHECK(row[i].worst.min_accel_mps2 > row[i - 1].worst.min_accel_mps2);

    row[0].others.stop_at_m = row[0].front_m() + 100;
    drive(60);
    for (std::size_t i = 1; i < row.size(); ++i) {
      CHECK(row[i].car.speed_mps == 0);
      CHECK(row[i - 1].rear_m() - row[i].front_m() == Approx(3).epsilon(0.1));
    }
  }
}
