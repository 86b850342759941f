// Bodies that move as was written down before.
#include "world/traffic/scripted_body.hpp"

#include "tests/support/toy_streets.hpp"
#include "tests/world/toy_user.hpp"
#include "world/traffic/traffic.hpp"

#include <doctest/doctest.h>

#include <numbers>

namespace sofof::scripted_bodies {

using namespace world;

namespace {

constexpr auto pi = std::numbers::pi;

scripted_body bus() {
  return {7, 12, 2.5, {{1, {0, 0}, 3, 4}, {2, {10, 4}, -3, 6}}};
}

} // namespace

TEST_CASE("a scripted body is between its moments, and turns the short way") {
  const auto body = bus().at(1.25);
  REQUIRE(body);
  CHECK(body->id == 7);
  CHECK(body->box.centre == point{2.5, 1});
  CHECK(body->box.heading_rad == doctest::Approx(3 + 0.25 * (2 * pi - 6)));
  CHECK(body->box.length_m == 12);
  CHECK(body->box.width_m == 2.5);
  CHECK(body->speed_mps == 4.5);
  CHECK(body->accel_mps2 == 2);
}

TEST_CASE("a scripted body is there from its first to its last moment") {
  CHECK_FALSE(bus().at(0.999));
  CHECK(bus().at(1)->box.centre == point{0, 0});
  CHECK(bus().at(2)->box.centre == point{10, 4});
  CHECK_FALSE(bus().at(2.001));
  const scripted_body flash{7, 1, 1, {{3, {1, 2}, 0, 0}}};
  CHECK(flash.at(3)->box.centre == point{1, 2});
  CHECK_FALSE(flash.at(3.1));
}

TEST_CASE("a body that moves by itself touches drivers, not what stands") {
  const auto map = toy::cross_roads();
  traffic all{map, {{90, {{500, 500}, 0, 4, 2}, 0, 0}}};
  const auto driver = toy::user(1, toy::make_route(map, {3, 0, 1}), 20);
  all.report(driver);
  all.place({{80, driver.body, 5, 0}, {81, {{500, 501}, 0, 4, 2}, 5, 0}});
  all.update({});
  REQUIRE(all.bodies().size() == 4);
  CHECK(all.bodies()[2].id == 80);
  CHECK(all.collisions()
        == std::vector{std::pair<station_id, station_id>{1, 80}});
  all.place({});
  all.update({});
  CHECK(all.bodies().size() == 2);
  CHECK(all.collisions().empty());
}

} // namespace sofof::scripted_bodies
