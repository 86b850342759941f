// Driving in closed loop with the optimiser: comfort, queues, emergencies.
#include "tests/planners/random_road.hpp"
#include "tests/planners/usual_drive.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using doctest::Approx;
using test::optimal;
using test::style;
using test::test_drive;
using test::town;

namespace {

constexpr auto share = 1.02; // of limits, for published plans

/// Behind others.
void check_calm(const test_drive& drive) {
  CHECK(drive.worst.lateral_m < corridor::freedom_m + 0.05);
  CHECK(drive.worst.over_limit < 1.01);
  CHECK(drive.worst.min_accel_mps2 > -2.6);
  CHECK(drive.worst.plan_gap_m < 0.002);
}

void check_comfort(const test_drive& drive) {
  check_calm(drive);
  CHECK(drive.emergencies == 0);
  CHECK(drive.worst.plan_jerk_mps3 < share * style.max_jerk_mps3);
  CHECK(drive.worst.plan_lateral_mps2 < share * style.max_lateral_accel_mps2);
  CHECK(drive.worst.jerk_mps3 < 1.25 * style.max_jerk_mps3);
}

/// One who drives ahead at whatever speed.
struct rabbit {
  double rear_m, speed_mps;
  double accel_mps2 = 0;

  lead_vehicle seen() const { return {1, rear_m, speed_mps, accel_mps2}; }
  void go(double seconds = 0.05) {
    const auto x =
        advance({rear_m, speed_mps, accel_mps2}, accel_mps2, seconds);
    rear_m = x.s_m;
    speed_mps = x.speed_mps;
  }
};

/// Cars in a row, each behind the one before.
struct row {
  row(const route_ptr& way, int cars, double first_m, double spacing_m,
      double speed_mps = 0) {
    for (auto i = 0; i < cars; ++i)
      all.push_back(optimal(way, first_m - spacing_m * i, speed_mps));
  }

  void cycle() {
    for (std::size_t i = 1; i < all.size(); ++i)
      all[i].others.lead = all[i - 1].as_lead();
    for (auto& car : all)
      car.cycle();
    for (std::size_t i = 1; i < all.size(); ++i)
      least_gap_m = std::min(least_gap_m, gap_m(i));
  }
  void drive(double seconds) {
    for (auto t = 0.0; t < seconds - 1e-6; t += 0.05)
      cycle();
  }
  double gap_m(std::size_t i) const {
    return all[i - 1].rear_m() - all[i].front_m();
  }

  std::vector<test_drive> all;
  double least_gap_m = 1e9;
};

} // namespace

TEST_CASE("the optimiser drives two laps in its lane, within limits, in "
          "comfort") {
  const auto way = test::oval(town);
  auto drive = optimal(way, 5, 0);
  drive.drive(180);
  CHECK(drive.s_m() > 2 * way->length_m());
  check_comfort(drive);
  CHECK(drive.worst.plan_change_m < 0.15);
}

TEST_CASE("the optimiser drives random roads to their end, in comfort") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    CAPTURE(seed);
    const auto way = test::random_road(seed, 400);
    auto drive = optimal(way, 2, 0);
    drive.drive(100);
    check_comfort(drive);
    CHECK(drive.car.speed_mps == 0);
    CHECK(drive.front_m() < way->length_m());
    CHECK(drive.front_m() > way->length_m() - 0.6);
  }
}

TEST_CASE("a longer horizon, finer steps or more ways to weigh drive as well") {
  const auto way = test::oval(town);
  for (const auto& params :
       {spatial_params{125, 0.5, 4, 1, 0}, spatial_params{160, 1, 8, 2, 0},
        spatial_params{40, 1, 1, 1, 0}, spatial_params{80, 2, 2, 1, 0}}) {
    CAPTURE(params.horizon_m);
    CAPTURE(params.step_m);
    auto drive = optimal(way, 5, 0, params);
    drive.drive(90);
    CHECK(drive.s_m() > 700);
    check_comfort(drive);
  }
}

TEST_CASE("the optimiser's inputs may be 0.4 s old") {
  auto drive = optimal(test::oval(town), 5, 0);
  drive.staleness = from_seconds(0.4);
  drive.drive(90);
  CHECK(drive.s_m() > 700);
  check_comfort(drive);
  CHECK(drive.worst.plan_change_m < 0.15);
}

TEST_CASE("the optimiser stops shortly before a line, stands still, and goes "
          "on when the line opens") {
  for (const auto speed : {3.0, 5.0, 8.3, 13.9}) {
    CAPTURE(speed);
    auto drive = optimal(test::straight(600, {{0, speed}}), 0, speed);
    drive.others.stop_at_m = 150;
    drive.drive(150 / speed + 10);
    check_comfort(drive);
    CHECK(drive.front_m() < 150);
    CHECK(drive.front_m() > 149.3);
    CHECK(drive.car.speed_mps == 0);
    const auto standing = drive.car;
    drive.drive(5);
    CHECK(drive.car.at == standing.at);

    drive.others.stop_at_m.reset();
    auto before = 0.0;
    for (auto i = 0; i < 20 * 8; ++i) {
      drive.cycle();
      REQUIRE(drive.car.speed_mps >= before - 5e-3);
      before = drive.car.speed_mps;
    }
    CHECK(before > 0.75 * std::min(speed, 8.0));
    check_comfort(drive);
  }
}

TEST_CASE("the optimiser does not stop at lines that open in time, and calmly "
          "goes on where they open late") {
  for (auto opens_s = 1.0; opens_s < 14; opens_s += 0.7) {
    CAPTURE(opens_s);
    auto drive = optimal(test::straight(900, {{0, 13.9}}), 0, 13.9);
    drive.others.stop_at_m = 150;
    auto slowest = 13.9;
    for (auto t = 0.0; t < 25; t += 0.05) {
      if (t > opens_s)
        drive.others.stop_at_m.reset();
      drive.cycle();
      slowest = std::min(slowest, drive.car.speed_mps);
      REQUIRE((!drive.others.stop_at_m || drive.front_m() < 150));
    }
    check_calm(drive);
    CHECK(drive.car.speed_mps > 10);
    if (opens_s < 5)
      CHECK(slowest > 12);
  }
}

TEST_CASE("a line that closes late is an emergency, is told so, and is not "
          "passed") {
  for (const auto room : {21.0, 23.0, 26.0, 30.0, 33.0}) {
    CAPTURE(room);
    auto drive = optimal(test::straight(600, {{0, 13.9}}), 0, 13.9);
    drive.drive(2);
    const auto line_m = drive.front_m() + room;
    drive.others.stop_at_m = line_m;
    drive.cycle();
    CHECK(drive.report.emergency);
    drive.drive(10);
    CHECK(drive.car.speed_mps == 0);
    CHECK(drive.front_m() < line_m);
    CHECK(drive.front_m() > line_m - 4);
    CHECK(drive.worst.min_accel_mps2 < -3);
    drive.others.stop_at_m.reset();
    drive.drive(10);
    CHECK(drive.car.speed_mps > 5);
    CHECK(!drive.report.emergency);
  }
}

TEST_CASE("the optimiser never hits a car ahead that brakes as hard as it can, "
          "and calls it an emergency") {
  for (const auto age_s : {0.0, 0.1, 0.4})
    for (const auto speed : {3.0, 8.3, 13.9, 27.8}) {
      CAPTURE(age_s);
      CAPTURE(speed);
      auto drive = optimal(test::straight(2000, {{0, speed}}), 0, speed);
      drive.staleness = from_seconds(age_s);
      rabbit lead{drive.front_m() + style.standstill_gap_m
                      + style.time_gap_s * speed,
                  speed};
      for (auto i = 0; i < 20 * 30; ++i) {
        if (i == 20 * 3)
          lead.accel_mps2 = -6;
        drive.others.lead = lead.seen();
        drive.cycle();
        lead.go();
        REQUIRE(lead.rear_m - drive.front_m() > 0.8);
        if (i < 20 * 3)
          REQUIRE(!drive.report.emergency);
      }
      CHECK(drive.car.speed_mps == 0);
      CHECK(lead.rear_m - drive.front_m() < 6);
      if (speed > 5)
        CHECK(drive.emergencies > 0);
    }
}

TEST_CASE("a car that cuts in is given its room back without hard braking") {
  for (const auto gap : {6.0, 8.0, 12.0})
    for (const auto slower : {0.0, 1.0, 2.0}) {
      CAPTURE(gap);
      CAPTURE(slower);
      auto drive = optimal(test::straight(2000, {{0, 13.9}}), 0, 12);
      drive.drive(3);
      rabbit lead{drive.front_m() + gap, drive.car.speed_mps - slower};
      auto least = gap;
      for (auto i = 0; i < 20 * 40; ++i) {
        drive.others.lead = lead.seen();
        drive.cycle();
        lead.go();
        least = std::min(least, lead.rear_m - drive.front_m());
      }
      CHECK(drive.worst.min_accel_mps2 > -3);
      CHECK(drive.worst.jerk_mps3 < 3); // beyond 2 it is called an emergency
      CHECK(drive.worst.plan_gap_m < 0.002);
      CHECK(least > 0.5 * gap);
      CHECK(lead.rear_m - drive.front_m()
            > style.standstill_gap_m + style.time_gap_s * lead.speed_mps);
    }
}

TEST_CASE("a car ahead that stops as cars do is followed by the optimiser in "
          "comfort") {
  const auto way = test::straight(900, {{0, 13.9}});
  row two{way, 2, 60, 30, 13.9};
  two.all[0].others.stop_at_m = 300;
  two.drive(40);
  CHECK(two.all[1].car.speed_mps == 0);
  CHECK(two.gap_m(1) == Approx(3).epsilon(0.2));
  check_comfort(two.all[0]);
  check_calm(two.all[1]);
}

TEST_CASE("six cars in a row start, follow and stop, the later the calmer") {
  row six{test::straight(2000, {{0, 13.9}}), 6, 60, 9};
  six.drive(60);
  CHECK(six.least_gap_m > 2);
  for (auto& car : six.all) {
    CHECK(car.car.speed_mps == Approx(13.9).epsilon(0.05));
    check_calm(car);
    car.worst = {};
  }
  // Somebody cuts in before the first car for a while.
  for (auto i = 0; i < 80; ++i) {
    auto& first = six.all[0];
    first.others.lead =
        lead_vehicle{9, first.front_m() + 8, first.car.speed_mps - 1, 0};
    six.cycle();
  }
  six.all[0].others.lead.reset();
  six.drive(40);
  for (std::size_t i = 1; i < six.all.size(); ++i) {
    CAPTURE(i);
    CHECK(six.all[i].worst.min_accel_mps2
          > six.all[i - 1].worst.min_accel_mps2 - 0.05);
    check_calm(six.all[i]);
  }
  six.all[0].others.stop_at_m = six.all[0].front_m() + 100;
  six.drive(60);
  CHECK(six.least_gap_m > 2);
  for (std::size_t i = 1; i < six.all.size(); ++i) {
    CAPTURE(i);
    CHECK(six.all[i].car.speed_mps == 0);
    CHECK(six.gap_m(i) == Approx(3).epsilon(0.2));
    check_calm(six.all[i]);
  }
}

TEST_CASE("behind one who crawls four cars move smoothly, stop and go or not, "
          "and never touch") {
  for (const auto speed : {0.3, 1.0, 1.5, 2.0, 3.0}) {
    CAPTURE(speed);
    row four{test::straight(900, {{0, 13.9}}), 4, 40, 9};
    rabbit lead{four.all[0].front_m() + 4, speed};
    const auto lead_from = lead.rear_m;
    const auto last_from = four.all.back().s_m();
    for (auto i = 0; i < 20 * 90; ++i) {
      four.all[0].others.lead = lead.seen();
      four.cycle();
      lead.go();
      REQUIRE(lead.rear_m - four.all[0].front_m() > 1);
      REQUIRE(four.least_gap_m > 1);
    }
    for (const auto& car : four.all)
      check_calm(car);
    // The last one keeps up.
    const auto behind =
        lead.rear_m - lead_from - four.all.back().s_m() + last_from;
    CHECK(behind < 12 + 14 * speed);
    lead.speed_mps = 0;
    for (auto i = 0; i < 20 * 40; ++i) {
      four.all[0].others.lead = lead.seen();
      four.cycle();
    }
    CHECK(four.least_gap_m > 1);
    for (const auto& car : four.all) {
      CHECK(car.car.speed_mps == 0);
      check_calm(car);
    }
  }
}

TEST_CASE("a standing optimiser does not creep after small openings") {
  auto drive = optimal(test::straight(600, {{0, 13.9}}), 10, 0);
  drive.others.stop_at_m = drive.front_m() + 0.4;
  drive.drive(5);
  CHECK(drive.s_m() == Approx(10));
  drive.others.stop_at_m.reset();
  drive.others.lead = lead_vehicle{1, drive.front_m() + 3.3, 0, 0};
  drive.drive(5);
  CHECK(drive.s_m() == Approx(10));
}
