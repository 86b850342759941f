// Tests of the judge of plans: what it refuses, after how many results, and
// what it must not refuse.
#include "planners/judges/plan_judge.hpp"

#include "tests/planners/judged_drive.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

using namespace sofof;
using namespace sofof::test;

TEST_CASE_FIXTURE(judged_drive, "a plan along the lane at the limit is used") {
  CHECK(refused_within(60s, 0).empty());
}

TEST_CASE_FIXTURE(judged_drive, "a plan that comes to rest where the street "
                                "ends is used, and goes on being used") {
  s_m = 1900;
  CHECK(refused_of(
            [&] {
              const auto room_m = way->length_m() - s_m - 4.1;
              return plan(room_m < 30 && speed_mps > 0
                              ? -speed_mps * speed_mps
                                    / (2 * std::max(room_m, 0.3))
                              : 0);
            },
            60s)
            .empty());
}

TEST_CASE_FIXTURE(judged_drive,
                  "a plan that begins elsewhere is not used, and the second of "
                  "three is refused") {
  auto x = plan(0);
  for (auto& p : x.points)
    p.at.y_m += 3;
  const auto first = ask(x);
  CHECK(!first.usable);
  CHECK(!first.refused);
  const auto second = ask(x);
  REQUIRE(second.refused);
  CHECK(second.refused->check == "place");
  CHECK(second.refused->value == doctest::Approx(3));
}

TEST_CASE_FIXTURE(judged_drive, "a plan of another speed is refused") {
  auto x = plan(0);
  for (auto& p : x.points)
    p.speed_mps = 6;
  ask(x);
  REQUIRE(ask(x).refused);
}

TEST_CASE_FIXTURE(judged_drive, "an old plan is refused") {
  const auto x = plan(0);
  now += 250ms;
  s_m += 2.5;
  CHECK(!ask(x).refused);
  REQUIRE(ask(x).refused);
  CHECK(ask(x).refused->check == "age");
}

TEST_CASE_FIXTURE(judged_drive, "a plan that was sent before is refused while "
                                "the car moves, and used while it stands") {
  fingerprint = 7;
  CHECK(ask(plan(0)).usable);
  CHECK(ask(plan(0)).usable); // it has come twice
  now += 50ms;
  CHECK(!ask(plan(0)).usable);
  now += 50ms;
  REQUIRE(ask(plan(0)).refused);
  CHECK(ask(plan(0)).refused->check == "repetition");
  speed_mps = 0;
  CHECK(ask(plan(0)).usable);
}

TEST_CASE_FIXTURE(judged_drive, "the plan of the lap before is used, once the "
                                "car has come round the block") {
  fingerprint = 7;
  CHECK(ask(plan(0)).usable);
  now += 20s;
  CHECK(ask(plan(0)).usable);
  now += 50ms;
  CHECK(!ask(plan(0)).usable);
}

TEST_CASE_FIXTURE(judged_drive, "a plan off the lane is refused long before "
                                "the car is there") {
  CHECK(refused_within(5s, 0, -0.06) == "road");
  CHECK(std::abs(d_m) + 1.89 / 2 < 1.75);
}

TEST_CASE_FIXTURE(judged_drive, "a plan that stays a little beyond the lane is "
                                "refused at the second result") {
  d_m = -0.9; // 9.5 cm beyond
  CHECK(!ask(plan(0)).refused);
  REQUIRE(ask(plan(0)).refused);
  CHECK(ask(plan(0)).refused->check == "road");
}

TEST_CASE_FIXTURE(judged_drive, "a plan whose front axle leaves the lane is "
                                "refused, wherever its rear axle is") {
  d_m = 0.5;
  auto askew = plan(0);
  CHECK(ask(askew).usable);
  for (auto& p : askew.points)
    p.heading_rad = 0.25; // its front is 0.78 m farther left
  const auto verdict = ask(askew);
  REQUIRE(verdict.refused);
  CHECK(verdict.refused->check == "road");
}

TEST_CASE_FIXTURE(judged_drive, "a car that does not know where it is judges "
                                "no plan, and uses none") {
  own_age = 200ms + 1ns;
  for (int k = 0; k < 5; ++k) {
    const auto verdict = ask(plan(0));
    CHECK_FALSE(verdict.usable);
    CHECK_FALSE(verdict.refused);
    CHECK_FALSE(verdict.useless);
  }
}

TEST_CASE_FIXTURE(judged_drive,
                  "a plan that leads back into the lane is used") {
  d_m = -1.2;
  CHECK(ask(plan(0, 0.05)).usable);
}

TEST_CASE_FIXTURE(judged_drive, "a plan faster than the limit is refused") {
  CHECK(refused_within(5s, 1.5) == "speed");
  CHECK(speed_mps < 1.1 * 10 + 0.8);
}

TEST_CASE_FIXTURE(
    judged_drive,
    "a plan that speeds up or turns as no car should is refused") {
  speed_mps = 5;
  CHECK(ask(plan(4)).refused->check == "along");
  speed_mps = 10;
  auto x = plan(0);
  for (auto& p : x.points)
    p.curvature_1pm = 0.05; // 5 m/s²
  CHECK(ask(x).refused->check == "across");
}

TEST_CASE_FIXTURE(
    judged_drive,
    "a plan over the stop line is refused while the car can stop") {
  seen.stop_at_m = 260;
  CHECK(refused_within(10s, 0) == "stop_line");
  const auto front_m = s_m + vehicle_params{}.front_m;
  CHECK(*seen.stop_at_m - front_m > speed_mps * speed_mps / (2 * 4.5));
}

TEST_CASE_FIXTURE(judged_drive, "a plan that stops at the line is used") {
  seen.stop_at_m = 260;
  CHECK(refused_of(
            [&] {
              const auto room_m = 260 - s_m - vehicle_params{}.front_m;
              const auto needed =
                  speed_mps * speed_mps / (2 * std::max(room_m, 0.1));
              const auto brakes = needed > 1.9 || room_m < 1;
              return plan(brakes ? -std::max(needed, 1.9) : 0);
            },
            20s)
            .empty());
  CHECK(speed_mps < 0.5);
}

TEST_CASE_FIXTURE(judged_drive, "a line that cannot be kept any more is no "
                                "reason to refuse a plan") {
  seen.stop_at_m = s_m + vehicle_params{}.front_m + 5;
  CHECK(ask(plan(0)).usable);
}

TEST_CASE_FIXTURE(judged_drive, "a plan into a standing car is refused while "
                                "firm braking can still avoid it") {
  see_car(280, 0, 0, 0);
  CHECK(refused_within(10s, 0) == "others");
  const auto room_m = 280 - 2.25 - s_m - vehicle_params{}.front_m;
  CHECK(room_m > speed_mps * speed_mps / (2 * 6) + 0.3 * speed_mps);
}

TEST_CASE_FIXTURE(judged_drive, "a plan that creeps into a standing car is "
                                "refused before it is there") {
  const auto room_m = 1.0;
  const auto rear_m = s_m + vehicle_params{}.front_m + room_m;
  see_car(rear_m + 2.25, 0, 0, 0);
  speed_mps = 0;
  CHECK(refused_of([this] { return plan(1, 0, 0.2); }, 20s) == "others");
  CHECK(s_m + vehicle_params{}.front_m < rear_m);
}

TEST_CASE_FIXTURE(judged_drive, "who stands close behind a car follows not "
                                "even the first plan that moves it on") {
  see_car(s_m + vehicle_params{}.front_m + 0.3 + 2.25, 0, 0, 0);
  speed_mps = 0;
  const auto first = ask(plan(0.3, 0, 0.5));
  CHECK(!first.usable);
  CHECK(!first.refused);
  CHECK(first.useless->check == "others");
  CHECK(ask(plan(0.3, 0, 0.5)).refused->check == "others");
}

TEST_CASE_FIXTURE(judged_drive, "a plan into a standing car is refused also "
                                "when the own car is nearer than it should") {
  see_car(s_m + vehicle_params{}.front_m + 0.4 + 2.25, 0, 0, 0);
  speed_mps = 0.1;
  const auto begins_m = s_m;
  CHECK(refused_within(5s, 0.5) == "others");
  CHECK(s_m < begins_m + 0.1);
}

TEST_CASE_FIXTURE(judged_drive, "who comes the other way, in its own lane, is "
                                "no reason to refuse a plan") {
  see_car(260, 3.5, std::numbers::pi, 14);
  CHECK(refused_within(2s, 0).empty());
}

TEST_CASE_FIXTURE(judged_drive, "who crosses and can stop before the lane is "
                                "no reason to refuse a plan; who cannot is") {
  see_car(222, -20, std::numbers::pi / 2, 8);
  CHECK(refused_within(200ms, 0).empty());
  seen.objects.clear();
  see_car(222, -20, std::numbers::pi / 2, 12);
  CHECK(refused_within(200ms, 0) == "others");
}

TEST_CASE_FIXTURE(judged_drive, "who crosses the own planner's way as well is "
                                "no reason to refuse a plan") {
  see_car(222, -20, std::numbers::pi / 2, 12);
  SUBCASE("which keeps its speed") {
    own_accel_mps2 = 0;
    CHECK(refused_within(400ms, 0).empty());
  }
  SUBCASE("but who crosses only that of the plan is") {
    CHECK(refused_within(400ms, 0) == "others");
  }
}

TEST_CASE_FIXTURE(judged_drive,
                  "a plan into a car that stands half in the lane "
                  "is refused") {
  see_car(280, 1.5, 0, 0);
  CHECK(refused_within(10s, 0) == "others");
}

TEST_CASE_FIXTURE(judged_drive, "where braking hits as well, a plan is used") {
  see_car(s_m + vehicle_params{}.front_m + 2.25 + 4, 0, 0, 0);
  CHECK(refused_within(200ms, -8).empty());
}

TEST_CASE_FIXTURE(judged_drive, "a plan of the future, or one that is over "
                                "soon, is of no use") {
  auto x = plan(0);
  SUBCASE("of the future") {
    x.start += 10ms;
    const auto verdict = ask(x);
    CHECK(!verdict.usable);
    CHECK(!verdict.useless); // clocks of two hosts differ
  }
  SUBCASE("over soon") {
    x.points.resize(21); // 2 s
    const auto verdict = ask(x);
    CHECK(!verdict.usable);
    REQUIRE(verdict.useless);
    CHECK(verdict.useless->check == "length");
  }
}

TEST_CASE_FIXTURE(judged_drive, "how far a plan stays within each limit is "
                                "told") {
  seen.stop_at_m = 300;
  d_m = 0.2;
  REQUIRE(ask(plan(-1)).usable);
  const auto left = [&](std::string_view name) {
    const auto found = std::ranges::find(judge.margins(), name, &margin::name);
    REQUIRE(found != judge.margins().end());
    return found->left;
  };
  const vehicle_params car;
  const auto edge_m = way->half_width_m(s_m) - car.width_m / 2;
  CHECK(left("road_m") == doctest::Approx(edge_m - 0.2 + 0.25));
  CHECK(left("speed_mps") == doctest::Approx(1.5)); // 11.5 allowed, 10 driven
  CHECK(left("along_mps2") == doctest::Approx(4.5));
  CHECK(left("across_mps2") == doctest::Approx(4.5));
  CHECK(left("place_m") == doctest::Approx(1));
  CHECK(left("standing_s") == doctest::Approx(1.2));
  CHECK(left("stop_line_m") > 0);
  seen.stop_at_m.reset();
  REQUIRE(ask(plan(-1)).usable);
  CHECK(judge.margins().size() == 9);
}

TEST_CASE("what is no plan is refused at the second of three") {
  plan_judge judge;
  CHECK(!judge.judge_unreadable().refused);
  REQUIRE(judge.judge_unreadable().refused);
  CHECK(judge.judge_unreadable().refused->check == "readable");
}

TEST_CASE_FIXTURE(judged_drive, "plans that cannot be used for one reason and "
                                "then for another are refused") {
  auto elsewhere = plan(0);
  for (auto& p : elsewhere.points)
    p.at.y_m += 3;
  CHECK(!ask(elsewhere).refused);
  CHECK(judge.judge_unreadable().refused);
}

TEST_CASE_FIXTURE(judged_drive, "a car that cannot brake as hard as its plans "
                                "for nothing say is told of the braking") {
  const auto check = refused_of(
      [&] {
        auto x = plan(-9);
        for (auto& p : x.points)
          p.speed_mps += 1.4; // it is still so fast
        return x;
      },
      2s);
  CHECK(check == "braking");
}
