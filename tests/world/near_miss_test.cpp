// Tests of time to collision and of near misses.
#include "world/traffic/near_miss.hpp"

#include "tests/support/dice.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <numbers>

using namespace sofof;
using namespace sofof::test;
using namespace sofof::world;
using namespace std::chrono_literals;

namespace {

constexpr double east = 0, north = std::numbers::pi / 2,
                 west = std::numbers::pi;

road_body driving_car(station_id id, point at, double heading_rad,
                      double speed_mps) {
  return {id, {at, heading_rad, 5, 2}, speed_mps, 0};
}

/// @returns where a body is after a while.
oriented_box box_after(const road_body& x, double t_s) {
  auto box = x.box;
  box.centre =
      box.centre
      + t_s * x.speed_mps
            * point{std::cos(box.heading_rad), std::sin(box.heading_rad)};
  return box;
}

struct watch_world {
  near_miss_watch watch;
  time_point now{1h};

  std::size_t look(const std::vector<road_body>& bodies, duration passed) {
    now += passed;
    return watch.look(bodies, now).size();
  }
};

} // namespace

TEST_CASE("who catches up touches when the gap is used up") {
  const auto behind = driving_car(1, {0, 0}, east, 15),
             ahead = driving_car(2, {25, 0}, east, 5);
  CHECK(time_to_collision_s(behind, ahead).value() == near(2, 1e-12));
  CHECK(time_to_collision_s(ahead, behind).value() == near(2, 1e-12));
}

TEST_CASE("who falls behind, or keeps his distance, never touches") {
  CHECK(!time_to_collision_s(driving_car(1, {0, 0}, east, 5),
                             driving_car(2, {25, 0}, east, 15)));
  CHECK(!time_to_collision_s(driving_car(1, {0, 0}, east, 5),
                             driving_car(2, {25, 0}, east, 5)));
}

TEST_CASE("oncoming cars in lanes of their own pass") {
  CHECK(!time_to_collision_s(driving_car(1, {0, 0}, east, 15),
                             driving_car(2, {30, 3.5}, west, 15)));
  CHECK(time_to_collision_s(driving_car(1, {0, 0}, east, 15),
                            driving_car(2, {30, 1.5}, west, 15))
            .value()
        == near(25.0 / 30, 1e-12));
}

TEST_CASE("at a crossing it matters who is there when") {
  // Fronts reach the other's side after 2 s.
  CHECK(time_to_collision_s(driving_car(1, {-23.5, 0}, east, 10),
                            driving_car(2, {0, -23.5}, north, 10))
            .value()
        == near(2, 1e-12));
  CHECK(!time_to_collision_s(driving_car(1, {-23.5, 0}, east, 10),
                             driving_car(2, {0, -23.5}, north, 30)));
}

TEST_CASE("bodies that touch have no time left") {
  CHECK(time_to_collision_s(driving_car(1, {0, 0}, east, 0),
                            driving_car(2, {4, 0}, east, 0))
        == 0);
  CHECK(time_to_collision_s(driving_car(1, {0, 0}, east, 3),
                            driving_car(2, {4, 1}, west, 3))
        == 0);
}

TEST_CASE("at the time to collision bodies touch, and not before") {
  dice d{7};
  auto found = 0;
  for (auto k = 0; k < 3'000; ++k) {
    const auto any = [&d](station_id id) {
      return driving_car(id, {d.between(-30, 30), d.between(-30, 30)},
                         d.between(-4, 4), d.between(0, 20));
    };
    const auto a = any(1), b = any(2);
    const auto t_s = time_to_collision_s(a, b);
    if (!t_s) {
      for (auto s = 0.0; s < 10; s += 0.05)
        REQUIRE(!overlap(box_after(a, s), box_after(b, s)));
      continue;
    }
    ++found;
    constexpr auto moment_s = 1e-6;
    REQUIRE(
        overlap(box_after(a, *t_s + moment_s), box_after(b, *t_s + moment_s)));
    for (auto s = 0.0; s < *t_s - moment_s; s += 0.05)
      REQUIRE(!overlap(box_after(a, s), box_after(b, s)));
  }
  CHECK(found > 100);
}

TEST_CASE_FIXTURE(watch_world, "an encounter is a near miss once") {
  const auto at = [](double gap_m) {
    return std::vector{driving_car(7, {gap_m + 5, 0}, east, 0),
                       driving_car(3, {0, 0}, east, 10)};
  };
  CHECK(look(at(15.1), 50ms) == 0); // 1.51 s
  const auto& begun = watch.look(at(14.9), now += 50ms);
  REQUIRE(begun.size() == 1);
  CHECK(begun[0].first == 3);
  CHECK(begun[0].second == 7);
  CHECK(begun[0].time_to_collision_s == near(1.49, 1e-12));
  CHECK(look(at(14), 50ms) == 0);
  CHECK(look(at(16), 50ms) == 0); // brakes
  CHECK(look(at(14), 1s) == 0);   // and comes again
  CHECK(look(at(16), 50ms) == 0);
  CHECK(look(at(14), same_encounter + 50ms) == 1);
}

TEST_CASE_FIXTURE(watch_world, "of many, those that come near are found") {
  std::vector<road_body> all;
  for (station_id::rep k = 0; k < 20; ++k) { // each fifth is caught up with
    all.push_back(
        driving_car(2 * k + 2, {100.0 * k, 40.0 * (k % 3)}, east, 10));
    all.push_back(driving_car(
        2 * k + 1, {100.0 * k - (k % 5 == 0 ? 12 : 60), 40.0 * (k % 3)}, east,
        20));
  }
  const auto begun = watch.look(all, now);
  REQUIRE(begun.size() == 4);
  for (std::size_t i = 0; i < begun.size(); ++i) {
    CHECK(begun[i].first == 10 * i + 1);
    CHECK(begun[i].second == 10 * i + 2);
  }
}
