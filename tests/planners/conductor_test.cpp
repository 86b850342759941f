// All vehicles at a crossing, planned together.
#include "tests/planners/conducted_cars.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace std::chrono_literals;
using doctest::Approx;

namespace {

using test::conducted_cars;

constexpr std::size_t east = 1, north = 2, west = 3, south = 4;

} // namespace

TEST_CASE("a car alone is told to drive as it would") {
  conducted_cars at;
  at.add(101, east, west, 40, 8);
  const auto told = at.plan();
  REQUIRE(told.size() == 1);
  const auto& drive = told[0].drive;
  REQUIRE(drive.is_sound());
  CHECK(drive.start == at.now);
  CHECK(drive.points.front().s_m == Approx(40));
  const auto middle_m = (at.body.front_m - at.body.rear_m) / 2;
  const auto alone = drive_freely(*at.cars[0].way, {}, 40 + middle_m, 8, 200);
  CHECK(drive.points.back().t_s
        == Approx(alone.time_s(drive.points.back().s_m + middle_m))
               .epsilon(0.05));
}

TEST_CASE("two that would meet are told to drive one behind the other, neither "
          "comes to rest") {
  conducted_cars at;
  at.add(101, east, west, 40, 8);
  at.add(102, south, north, 40, 8);
  at.plan();
  auto slowest_mps = 1e9;
  for (int k = 0; k < 60 && !at.cars.empty(); ++k) {
    at.go_on();
    at.plan();
    for (const auto& x : at.cars)
      slowest_mps = std::min(slowest_mps, x.speed_mps);
  }
  CHECK(at.cars.empty());
  CHECK(at.touches == 0);
  CHECK(slowest_mps > 2);
  CHECK(std::abs(at.arrived_s[101] - at.arrived_s[102]) > 0.7);
}

TEST_CASE("what a car has claimed does not change, and others keep to it") {
  conducted_cars at;
  at.add(101, east, west, 80, 8);
  at.plan();
  const auto claimed = *at.cars[0].drive;
  at.add(102, south, north, 84, 9); // it would come first
  std::vector<approaching_car> all;
  for (const auto& x : at.cars)
    all.push_back({x.who, x.way, x.s_m, x.speed_mps, 0, true, x.drive,
                   x.who == station_id{101}});
  std::vector<crossing_advice> out;
  at.leads.plan(at.now, all, out);
  REQUIRE(out.size() == 1);
  CHECK(out[0].who == station_id{102});
  at.cars[1].drive = out[0].drive;
  at.cars[0].drive = claimed;
  for (int k = 0; k < 40; ++k)
    at.go_on();
  CHECK(at.touches == 0);
}

TEST_CASE(
    "cars that come one by one from all sides all get through, and no two "
    "touch") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    test::dice dice{seed};
    conducted_cars at;
    auto next = 101U;
    std::map<std::size_t, double> last_s; // of each arm
    for (int k = 0; k < 300 && (next < 119 || !at.cars.empty()); ++k) {
      const auto in = 1 + static_cast<std::size_t>(dice.between(0, 4));
      const auto out = 1 + static_cast<std::size_t>(dice.between(0, 4));
      const auto t = to_seconds(at.now - time_point{});
      if (next < 119 && in != out
          && (!last_s.contains(in) || t - last_s[in] > 4)) {
        const auto is_free = std::ranges::none_of(at.cars, [&](const auto& x) {
          return x.s_m < 45
                 && x.way->line.way().name().starts_with(std::to_string(in));
        });
        if (is_free) {
          at.add(next++, in, out, 25);
          last_s[in] = t;
        }
      }
      at.plan();
      at.go_on();
    }
    CHECK(at.cars.empty());
    CHECK(at.arrived_s.size() == 18);
    CHECK(at.touches == 0);
  }
}

TEST_CASE("the same cars are told the same") {
  const auto told = [] {
    conducted_cars at;
    at.add(101, east, west, 40, 8);
    at.add(102, south, north, 40, 8);
    at.add(103, west, south, 30, 6);
    std::vector<double> all;
    for (int k = 0; k < 10; ++k) {
      for (const auto& a : at.plan())
        for (const auto& p : a.drive.points)
          all.push_back(p.s_m);
      at.go_on();
    }
    return all;
  };
  CHECK(told() == told());
}
