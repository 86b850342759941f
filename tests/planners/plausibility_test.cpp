// A body that only its own messages know is not believed where others look;
// one that nobody can see is.
#include "planners/plausibility/plausibility.hpp"

#include "tests/support/watched_road.hpp"

#include <doctest/doctest.h>

#include <numbers>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::test;
using namespace sofof::world;

namespace {

perceived_object car_on_x(double x_m, double y_m = 0, double speed_mps = 0) {
  return {{x_m, y_m}, 0, speed_mps, 0, 5.1, 1.89};
}

sensor mast_at(point at, double range_m = 100) {
  return {{.range_m = range_m}, random_stream{1, "mast"}, at, 0, {}};
}

telling_car ghost(perceived_object is, sender_id sender = 0) {
  return {.is = is, .exists = false, .sender = sender};
}

telling_car watcher(perceived_object is, sender_id sender = 0) {
  return {.is = is, .sends_cpms = true, .sender = sender};
}

building block(point low, point high) {
  return {{low, {high.x_m, low.y_m}, high, {low.x_m, high.y_m}}};
}

} // namespace

TEST_CASE("a ghost in view of a sensor is believed in for half a second") {
  watched_road road;
  road.sensors = {mast_at({0, 20})};
  road.cars = {ghost(car_on_x(30))};
  road.pass(200ms);
  CHECK(road.believes_in(road.cars[0].is));
  road.pass(400ms);
  CHECK_FALSE(road.believes_in(road.cars[0].is));
  CHECK(road.doubts.doubts(1));
  REQUIRE(road.news.size() == 1);
  CHECK(road.news[0].station == 1);
  CHECK(road.news[0].check == doubt_check::sight);
  road.pass(60s);
  CHECK(road.news.size() == 1);
}

TEST_CASE("a car that a sensor sees is believed in, and never doubted") {
  watched_road road;
  road.sensors = {mast_at({0, 20})};
  road.cars = {{.is = car_on_x(30)}};
  road.pass(20s);
  CHECK(road.believes_in(road.cars[0].is));
  CHECK(road.news.empty());
}

TEST_CASE("what no sensor sees is believed in") {
  watched_road road{{block({5, 5}, {25, 15})}};
  road.sensors = {mast_at({0, 20}, 60)};
  SUBCASE("beyond its range") {
    road.cars = {ghost(car_on_x(80))};
  }
  SUBCASE("at its limit") {
    road.cars = {ghost(car_on_x(56))};
  }
  SUBCASE("behind a house") {
    road.cars = {ghost(car_on_x(28, -2))};
  }
  SUBCASE("behind a lorry") {
    road.cars = {ghost(car_on_x(-40, 20)),
                 {.is = {{-20, 20}, 1.57, 0, 0, 12, 3}}};
  }
  road.pass(10s);
  CHECK(road.believes_in(road.cars[0].is));
  CHECK(road.news.empty());
}

TEST_CASE("a vehicle that looks at the place does not believe in a ghost "
          "there, and nobody else is kept from it") {
  watched_road road;
  road.cars = {watcher(car_on_x(0)), ghost(car_on_x(40))};
  road.pass(1s);
  CHECK_FALSE(road.believes_in(road.cars[1].is, 1));
  CHECK(road.believes_in(road.cars[1].is, 3));
  SUBCASE("but a second sender that looks there convinces all") {
    road.cars.push_back(watcher(car_on_x(80)));
    road.pass(1s);
    CHECK_FALSE(road.believes_in(road.cars[1].is, 4));
  }
  SUBCASE("a second vehicle of the same sender does not") {
    road.cars.push_back(watcher(car_on_x(80), 1));
    road.pass(1s);
    CHECK(road.believes_in(road.cars[1].is, 4));
  }
}

TEST_CASE("what a vehicle's own sender tells of is not doubted because that "
          "vehicle does not see it") {
  watched_road road;
  road.cars = {watcher(car_on_x(0), 7), ghost(car_on_x(40), 7)};
  road.pass(2s);
  CHECK(road.believes_in(road.cars[1].is, 1));
  CHECK(road.news.empty());
  SUBCASE("but because a vehicle of another sender does not") {
    road.cars.push_back(watcher(car_on_x(80), 8));
    road.pass(1s);
    CHECK_FALSE(road.believes_in(road.cars[1].is, 3));
  }
}

TEST_CASE("a ghost that appears between two looks of a vehicle is not believed "
          "in for its plans, unless its own sender tells of it") {
  watched_road road;
  road.cars = {watcher(car_on_x(0), 7)};
  road.pass(2s);
  road.now += 50ms;
  const auto there = car_on_x(40);
  SUBCASE("a stranger") {
    road.hear(2, 8, there);
    CHECK_FALSE(road.believes_in(there, 1));
  }
  SUBCASE("its own sender") {
    road.hear(2, 7, there);
    CHECK(road.believes_in(there, 1));
  }
}

TEST_CASE("a sender found out by one ghost is not believed in its next one, "
          "though nobody has looked since") {
  watched_road road;
  road.cars = {watcher(car_on_x(0))};
  road.pass(2s);
  road.now += 50ms;
  road.hear(2, 77, car_on_x(40));
  // It has come into view just now: nobody has overlooked it.
  auto second = car_on_x(95.5);
  second.heading_rad = std::numbers::pi;
  second.speed_mps = 20;
  road.hear(3, 77, second);
  CHECK_FALSE(road.believes_in(second, 1));
}

TEST_CASE("a car that one liar denies is believed in by all others") {
  watched_road road;
  road.cars = {watcher(car_on_x(0)), {.is = car_on_x(40)}};
  road.cars[0].range_m = 0.1; // it pretends to see a hundred metres
  for (auto i = 0; i < 100; ++i) {
    road.pass();
    road_look sees_nothing;
    sees_nothing.at = sees_nothing.seen_at = road.now;
    sees_nothing.from.range_m = 100;
    road.doubts.judge({1, false, 1}, sees_nothing, road.model.tracks());
  }
  CHECK(road.believes_in(road.cars[1].is, 3));
}

TEST_CASE("a ghost that returns in another place is not believed in again") {
  watched_road road;
  road.sensors = {mast_at({0, 20})};
  SUBCASE("silent in between") {
    road.cars = {ghost(car_on_x(30))};
    road.pass(2s);
    road.cars[0].tells = false;
    road.pass(5s);
    road.cars = {ghost(car_on_x(-20))};
  }
  SUBCASE("by another station of its sender") {
    road.cars = {ghost(car_on_x(30), 77)};
    road.pass(2s);
    road.cars.push_back(ghost(car_on_x(-20), 77));
  }
  SUBCASE("longer, wider") {
    road.cars = {ghost(car_on_x(30))};
    road.pass(2s);
    road.cars[0].is.length_m = 25;
    road.cars[0].is.width_m = 2.5;
  }
  for (auto i = 0; i < 100; ++i) {
    road.pass();
    CHECK_FALSE(road.believes_in(road.cars.back().is));
  }
}

TEST_CASE("a car of a sender that has lied is believed in where it is seen, "
          "and where nobody can see it") {
  watched_road road{{block({-60, 5}, {-20, 15})}};
  road.sensors = {mast_at({0, 20})};
  road.cars = {ghost(car_on_x(30), 77),
               {.is = car_on_x(10, 8), .sender = 77},
               {.is = car_on_x(-40), .sender = 77}};
  road.pass(2s);
  for (auto i = 0; i < 100; ++i) {
    road.pass();
    CHECK(road.believes_in(road.cars[1].is));
    CHECK(road.believes_in(road.cars[2].is));
  }
}

TEST_CASE("a car that goes is forgotten, not doubted") {
  watched_road road;
  road.sensors = {mast_at({0, 20})};
  road.cars = {{.is = car_on_x(30)}, watcher(car_on_x(0))};
  road.pass(2s);
  road.cars[0].exists = road.cars[0].tells = false;
  road.pass(5s);
  CHECK(road.news.empty());
}

TEST_CASE("a car that stops in its messages alone is found out") {
  watched_road road;
  road.sensors = {mast_at({50, 20})};
  road.cars = {{.is = car_on_x(0, 0, 10)}};
  road.pass(2s);
  CHECK(road.news.empty());
  auto stands = road.cars[0].is;
  stands.speed_mps = 0;
  road.told = {stands};
  road.pass(3s);
  CHECK_FALSE(road.believes_in(stands));
  CHECK(road.believes_in(road.cars[0].is));
}

TEST_CASE("a ghost in a car that others see is doubted, the car is not") {
  watched_road road;
  road.sensors = {mast_at({50, 20}, 40)};
  road.cars = {{.is = car_on_x(30)}, ghost(car_on_x(33))};
  road.pass(5s);
  CHECK(road.believes_in(road.cars[0].is));
  CHECK_FALSE(road.doubts.doubts(1));
  CHECK_FALSE(road.believes_in(road.cars[1].is));
  REQUIRE(road.doubted() == 1);
  CHECK(road.news[0].station == 2);
  CHECK(road.news[0].check == doubt_check::overlap);
}

TEST_CASE("a station is told of once when it is doubted, and once when it is "
          "believed again") {
  watched_road road;
  road.sensors = {mast_at({0, 20})};
  road.cars = {ghost(car_on_x(30))};
  road.pass(5s);
  road.cars[0].exists = true; // it was its sensor that erred
  road.pass(15s);
  REQUIRE(road.news.size() == 2);
  CHECK(road.news[0].begins);
  CHECK_FALSE(road.news[1].begins);
  CHECK(road.believes_in(road.cars[0].is));
}

TEST_CASE("of what a witness tells, bodies that jump are left out") {
  watched_road road;
  road.cars = {watcher(car_on_x(0)), {.is = car_on_x(40)}};
  road.pass(1s);
  const station_id who{1};
  std::vector<std::uint32_t> ids{7, 8};
  std::vector<perceived_object> bodies{car_on_x(40), car_on_x(60)};
  road.doubts.sift(who, road.now, ids, bodies);
  CHECK(bodies.size() == 2);
  bodies = {car_on_x(90), car_on_x(60)};
  road.doubts.sift(who, road.now + 100ms, ids, bodies);
  CHECK(ids == std::vector<std::uint32_t>{8});
  REQUIRE(bodies.size() == 1);
  CHECK(bodies[0].centre.x_m == 60);
}
