// Tests of the map's place on Earth.
#include "messages/v2x/geo_frame.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::world;
using sofof::test::dice;

namespace {

constexpr geo_origin lehr{571656, 5364810, 32, 48.43236, 9.96873};
constexpr double per_degree = 1e7;

double degrees(std::int32_t e7) {
  return e7 / per_degree;
}

/// Distance and bearing (clockwise from north) over the ellipsoid.
struct leg {
  double length_m = 0, bearing_rad = 0;
};
leg between(geo_position a, geo_position b) {
  leg l;
  double at_b = 0;
  GeographicLib::Geodesic::WGS84().Inverse(
      degrees(a.latitude), degrees(a.longitude), degrees(b.latitude),
      degrees(b.longitude), l.length_m, l.bearing_rad, at_b);
  l.bearing_rad *= std::numbers::pi / 180;
  return l;
}

} // namespace

TEST_CASE("the map's origin lies where its file says") {
  const auto origin = geo_frame{lehr}.to_wgs84({0, 0});
  CHECK(std::abs(degrees(origin.latitude) - lehr.lat_deg) < 1e-5);
  CHECK(std::abs(degrees(origin.longitude) - lehr.lon_deg) < 1e-5);
  CHECK(geo_frame{}.to_wgs84({0, 0}) == origin); // of made-up maps
}

TEST_CASE("a well-known place is where everybody says") {
  // Baghdad in the manual of GeographicLib: 33.3° N 44.4° E.
  const geo_frame baghdad{{444140.54, 3684706.36, 38, 0, 0}};
  const auto at = baghdad.to_wgs84({0, 0});
  CHECK(std::abs(at.latitude - 333'000'000) <= 1);
  CHECK(std::abs(at.longitude - 444'000'000) <= 1);
}

TEST_CASE("there and back is the same place to a centimetre") {
  const geo_frame frame{lehr};
  dice d{1};
  for (int i = 0; i < 2000; ++i) {
    const point at{d.between(-3000, 3000), d.between(-3000, 3000)};
    const auto sent = frame.to_wgs84(at);
    const auto back = frame.to_map(sent);
    REQUIRE(back.has_value());
    // 1e-7° are 11 mm to the north and 7 mm to the east.
    REQUIRE(distance_m(*back, at) < 0.0068);
    REQUIRE(frame.to_wgs84(*back) == sent);
  }
}

TEST_CASE("a place is where the survey has it, up to the grid's scale") {
  const geo_frame frame{lehr};
  dice d{2};
  for (int i = 0; i < 500; ++i) {
    const auto angle = d.between(0, 2 * std::numbers::pi);
    const point at{1000 * std::cos(angle), 1000 * std::sin(angle)};
    const auto place = frame.to_wgs84(at);
    int zone = 0;
    auto north = false;
    point utm;
    GeographicLib::UTMUPS::Forward(degrees(place.latitude),
                                   degrees(place.longitude), zone, north,
                                   utm.x_m, utm.y_m);
    const point surveyed{utm.x_m - lehr.utm_e_m, utm.y_m - lehr.utm_n_m};
    REQUIRE(zone == 32);
    REQUIRE(distance_m(surveyed, at) < 0.4);
    REQUIRE(distance_m(surveyed, at) > 0.3); // so we say
    // Only lengths differ, not directions.
    REQUIRE(std::abs(cross(surveyed, at)) / 1000 < 0.03);
  }
}

TEST_CASE("lengths and headings hold on Earth, wherever on the map") {
  const geo_frame frame{lehr};
  dice d{3};
  for (int i = 0; i < 500; ++i) {
    const point at{d.between(-3000, 3000), d.between(-3000, 3000)};
    const auto heading = d.between(-10, 10);
    const point there = at + 300 * point{std::cos(heading), std::sin(heading)};
    const auto way = between(frame.to_wgs84(at), frame.to_wgs84(there));
    REQUIRE(way.length_m == doctest::Approx(300).epsilon(5e-5));

    const auto tenths = frame.to_etsi_heading(heading, at);
    REQUIRE(tenths >= 0);
    REQUIRE(tenths < 3600);
    const auto to_rad = std::numbers::pi / 1800;
    REQUIRE(std::abs(wrap_angle(tenths * to_rad - way.bearing_rad))
            < 0.06 * std::numbers::pi / 180);
    const auto back = frame.to_map_heading(tenths, at);
    REQUIRE(back.has_value());
    REQUIRE(std::abs(wrap_angle(*back - heading)) < 0.501 * to_rad);

    const point step{40, 30};
    const auto ahead = frame.to_map_axes(step, at);
    const auto bearing =
        between(frame.to_wgs84(at), frame.to_wgs84(at + ahead)).bearing_rad;
    REQUIRE(std::abs(wrap_angle(bearing - std::atan2(step.x_m, step.y_m)))
            < 5e-4);
    REQUIRE(distance_m(frame.to_east_north(ahead, at), step) < 1e-9);
  }
}

TEST_CASE("the map's north lies 0.7 degrees east of Earth's in Ulm") {
  const geo_frame frame{lehr};
  CHECK(frame.to_etsi_heading(std::numbers::pi / 2, {0, 0}) == 7);
  CHECK(frame.to_etsi_heading(0, {0, 0}) == 907);
}

TEST_CASE("what is no place on the map is none") {
  const geo_frame frame{lehr};
  CHECK(!frame.to_map({}));
  CHECK(!frame.to_map({geo_position::unavailable_latitude, 99687300}));
  CHECK(!frame.to_map({484323600, geo_position::unavailable_longitude}));
  CHECK(!frame.to_map({std::numeric_limits<std::int32_t>::min(), 0}));
  CHECK(!frame.to_map({-484323600, -1700000000})); // far away
  CHECK(!frame.to_map_heading(3601, {0, 0}));
  CHECK(!frame.to_map_heading(-1, {0, 0}));
  CHECK_THROWS_AS((geo_frame{{1e9, 5364810, 32, 0, 0}}), std::invalid_argument);
}
