// Points, polygons, polylines and footprints in the plane.
#include "base/geometry.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

using namespace sofof;
using std::numbers::pi;
using test::dice;

namespace {

const polygon square{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}};
const polygon bay{{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}};

} // namespace

TEST_CASE("an angle wraps to the half-open circle") {
  CHECK(wrap_angle(0) == 0);
  CHECK(wrap_angle(pi) == doctest::Approx(pi));
  CHECK(wrap_angle(-pi) == doctest::Approx(pi));
  CHECK(wrap_angle(3 * pi) == doctest::Approx(pi));
  CHECK(wrap_angle(-0.5 - 20 * pi) == doctest::Approx(-0.5));
  dice d{1};
  for (auto i = 0; i < 1000; ++i) {
    const auto angle = d.between(-100, 100);
    const auto wrapped = wrap_angle(angle);
    CHECK(wrapped > -pi);
    CHECK(wrapped <= pi);
    CHECK(std::cos(wrapped) == doctest::Approx(std::cos(angle)));
    CHECK(std::sin(wrapped) == doctest::Approx(std::sin(angle)));
  }
}

TEST_CASE("a polygon holds its inside and its rim, and nothing else") {
  CHECK(square.contains({1, 1}));
  CHECK(square.contains({0, 0}));
  CHECK(square.contains({2, 2}));
  CHECK(square.contains({2, 0.5}));
  CHECK(square.contains({0.3, 2}));
  CHECK_FALSE(square.contains({2.001, 1}));
  CHECK_FALSE(square.contains({-1, 0}));
  CHECK_FALSE(square.contains({3, 2}));
  CHECK_FALSE(square.contains({1, -1e-9}));
}

TEST_CASE("a bay of a polygon lies outside") {
  CHECK(bay.contains({0.5, 2}));
  CHECK(bay.contains({3.5, 2}));
  CHECK(bay.contains({2, 1}));
  CHECK_FALSE(bay.contains({2, 1.5}));
  CHECK_FALSE(bay.contains({2, 4}));
}

TEST_CASE("the sense in which the corners are listed does not matter") {
  std::vector<point> corners(bay.corners().begin(), bay.corners().end());
  std::ranges::reverse(corners);
  const polygon reversed{corners};
  dice d{2};
  for (auto i = 0; i < 2000; ++i) {
    const point p{d.between(-1, 5), d.between(-1, 5)};
    CHECK(bay.contains(p) == reversed.contains(p));
  }
}

TEST_CASE("a regular polygon lies between its two circles") {
  const auto area = polygon::regular({10, -5}, 300, 24);
  REQUIRE(area.corners().size() == 24);
  CHECK(area.corners()[0].x_m == doctest::Approx(310));
  CHECK(area.corners()[0].y_m == doctest::Approx(-5));
  const auto inner_m = 300 * std::cos(pi / 24);
  dice d{3};
  for (auto i = 0; i < 2000; ++i) {
    const point p{d.between(-330, 350), d.between(-345, 335)};
    const auto r = distance_m({10, -5}, p);
    if (r < inner_m - 1e-6)
      CHECK(area.contains(p));
    if (r > 300 + 1e-6)
      CHECK_FALSE(area.contains(p));
  }
}

TEST_CASE("a broken polygon is refused") {
  using corners = std::vector<point>;
  CHECK_THROWS_AS(polygon(corners{{0, 0}, {1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(polygon(corners{{0, 0}, {1, 0}, {1, 0}, {0, 1}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(polygon(corners{{0, 0}, {1, 0}, {0, 1}, {0, 0}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(polygon(corners{{0, 0}, {2, 2}, {2, 0}, {0, 2}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(polygon(corners{{0, 0}, {2, 0}, {1, 0}, {1, 1}}),
                  std::invalid_argument);
  // A corner on another edge closes off a part of the inside.
  CHECK_THROWS_AS(polygon(corners{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}),
                  std::invalid_argument);
}

TEST_CASE("the distance to a segment is that to its nearest point") {
  CHECK(distance_to_segment_m({1, 1}, {0, 0}, {2, 0}) == doctest::Approx(1));
  CHECK(distance_to_segment_m({-3, 4}, {0, 0}, {2, 0}) == doctest::Approx(5));
  CHECK(distance_to_segment_m({5, 4}, {0, 0}, {2, 0}) == doctest::Approx(5));
  CHECK(distance_to_segment_m({3, 4}, {0, 0}, {0, 0}) == doctest::Approx(5));
}

TEST_CASE("a polyline is as long as its pieces together") {
  const std::vector<point> line{{0, 0}, {3, 4}, {3, 10}};
  CHECK(length_m(line) == doctest::Approx(11));
  CHECK(length_m(std::span{line}.first(1)) == 0);
  CHECK(length_m({}) == 0);
}

TEST_CASE("cars in neighbouring lanes do not touch, bumper to bumper do") {
  const oriented_box car{{0, 0}, 0, 5.1, 1.89};
  CHECK_FALSE(overlap(car, {{0, 3.5}, pi, 5.1, 1.89}));
  CHECK(overlap(car, {{5.1, 0}, 0, 5.1, 1.89}));
  CHECK_FALSE(overlap(car, {{5.11, 0}, 0, 5.1, 1.89}));
  CHECK(overlap(car, {{0, 3}, pi / 2, 5.1, 1.89}));
  // Their shadows on the car's own axes overlap, on the diagonal they do not.
  CHECK_FALSE(overlap(car, {{3, 1.8}, 3 * pi / 4, 5.1, 1}));
}

TEST_CASE("whether two boxes touch depends on neither order nor frame") {
  dice d{4};
  for (auto i = 0; i < 2000; ++i) {
    const oriented_box a{
        {d.between(-4, 4), d.between(-4, 4)}, d.between(-4, 4), 5.1, 1.89};
    const oriented_box b{
        {d.between(-4, 4), d.between(-4, 4)}, d.between(-4, 4), 4, 2};
    const auto touching = overlap(a, b);
    CHECK(overlap(b, a) == touching);
    auto moved = [](oriented_box box) {
      box.centre = {7 - box.centre.y_m, 3 + box.centre.x_m};
      box.heading_rad += pi / 2;
      return box;
    };
    CHECK(overlap(moved(a), moved(b)) == touching);
  }
}

TEST_CASE("boxes touch exactly when a point of one lies in the other") {
  dice d{5};
  auto corner = [](const oriented_box& box, double u, double v) {
    const point along{std::cos(box.heading_rad), std::sin(box.heading_rad)};
    return box.centre + (u * box.length_m) * along
           + (v * box.width_m) * point{-along.y_m, along.x_m};
  };
  auto outline = [&](const oriented_box& b) {
    return polygon{{corner(b, -0.5, -0.5), corner(b, 0.5, -0.5),
                    corner(b, 0.5, 0.5), corner(b, -0.5, 0.5)}};
  };
  for (auto i = 0; i < 300; ++i) {
    const oriented_box a{{0, 0}, d.between(-4, 4), 5.1, 1.89};
    const oriented_box b{
        {d.between(-5, 5), d.between(-5, 5)}, d.between(-4, 4), 4, 2};
    const auto rim = outline(a);
    auto shared = false;
    for (auto u = -0.5; u <= 0.5; u += 0.05)
      for (auto v = -0.5; v <= 0.5; v += 0.05)
        shared = shared || rim.contains(corner(b, u, v));
    if (shared)
      CHECK(overlap(a, b));
    oriented_box shrunk = b;
    shrunk.length_m -= 0.6, shrunk.width_m -= 0.6;
    if (!shared)
      CHECK_FALSE(overlap(a, shrunk));
  }
}
