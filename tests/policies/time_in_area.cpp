// Tests of how long a route stays in an area, exact and against a reference.
#include "policies/filters/location.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using test::dice;

namespace {

const polygon square{{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}};

// A U: its notch, 10 < x < 20 above y = 10, lies outside.
const polygon letter_u{{{0, 0},
                        {30, 0},
                        {30, 20},
                        {20, 20},
                        {20, 10},
                        {10, 10},
                        {10, 20},
                        {0, 20}}};

using line = std::vector<point>;

/// Inside, by the turns that the rim makes round a point; nothing that ray
/// casting has in common with it.
bool is_inside(std::span<const point> rim, point p) {
  double turned = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const auto a = rim[i] - p, b = rim[(i + 1) % rim.size()] - p;
    turned += std::atan2(cross(a, b), dot(a, b));
  }
  return std::abs(turned) > std::numbers::pi;
}

/// What the docstring says, literally.
std::optional<double> reference_s(const line& route, const polygon& area,
                                  double speed_mps) {
  std::vector<bool> inside;
  for (const auto p : route)
    inside.push_back(is_inside(area.corners(), p));
  if (route.empty() || !inside.front())
    return std::nullopt;
  if (speed_mps < 0.1)
    return std::numeric_limits<double>::infinity();
  double sum_s = 0;
  for (std::size_t i = 1; i < route.size() && inside[i]; ++i)
    sum_s += std::hypot(route[i].x_m - route[i - 1].x_m,
                        route[i].y_m - route[i - 1].y_m)
             / speed_mps;
  return sum_s;
}

/// A star-shaped polygon round the origin, mostly concave.
polygon random_star(dice& random) {
  const auto n = static_cast<int>(random.between(3, 20));
  line corners;
  for (int k = 0; k < n; ++k) {
    const auto angle = 2 * std::numbers::pi * k / n;
    const auto r = random.between(5, 100);
    corners.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return polygon{corners};
}

line random_walk(dice& random) {
  line route{{random.between(-40, 40), random.between(-40, 40)}};
  auto heading = random.between(0, 6.28);
  const auto n = static_cast<int>(random.between(0, 40));
  for (int k = 0; k < n; ++k) {
    heading += random.between(-0.5, 0.5);
    route.push_back(route.back()
                    + random.between(1, 10)
                          * point{std::cos(heading), std::sin(heading)});
  }
  return route;
}

} // namespace

TEST_CASE("a vehicle at the rim is inside: its way through the square counts") {
  CHECK(time_in_area_s(line{{10, 0}, {5, 0}, {-10, 0}, {-15, 0}}, square, 2)
        == 10.0);
}

TEST_CASE("a vehicle at the rim that drives out stays no time at all") {
  CHECK(time_in_area_s(line{{10, 0}, {11, 0}}, square, 2) == 0.0);
}

TEST_CASE("a route along the rim stays inside") {
  CHECK(time_in_area_s(line{{-10, 10}, {0, 10}, {10, 10}}, square, 2) == 10.0);
}

TEST_CASE("a route that begins outside has no time in the area") {
  CHECK(!time_in_area_s(line{{10.001, 0}, {0, 0}}, square, 2));
  CHECK(!time_in_area_s(line{{10.001, 0}, {0, 0}}, square, 0));
}

TEST_CASE("where there is no route there is no time in the area") {
  CHECK(!time_in_area_s({}, square, 2));
}

TEST_CASE("of a route that leaves the area and comes back, only the first "
          "part counts") {
  const line route{{2, 15}, {5, 15}, {9, 15}, {15, 15}, {21, 15}, {28, 15}};
  CHECK(time_in_area_s(route, letter_u, 1) == 7.0);
}

TEST_CASE("a route round the notch never leaves the area") {
  const line route{{5, 15}, {5, 5}, {25, 5}, {25, 15}};
  CHECK(time_in_area_s(route, letter_u, 1) == 40.0);
}

TEST_CASE("a route that ends inside counts in full") {
  CHECK(time_in_area_s(line{{0, 0}, {3, 4}, {3, 9}}, square, 2) == 5.0);
  CHECK(time_in_area_s(line{{0, 0}}, square, 2) == 0.0);
}

TEST_CASE("a standing vehicle stays for ever, wherever its route leads") {
  const auto forever = std::numeric_limits<double>::infinity();
  CHECK(time_in_area_s(line{{0, 0}, {100, 0}}, square, 0) == forever);
  CHECK(time_in_area_s(line{{0, 0}, {100, 0}}, square, 0.099) == forever);
}

TEST_CASE("at a tenth of a metre per second a vehicle moves") {
  CHECK(*time_in_area_s(line{{0, 0}, {9, 0}, {11, 0}}, square, 0.1)
        == doctest::Approx(90));
}

TEST_CASE("the time in the area is that of a literal reference, whatever the "
          "area and the route") {
  dice random{2024};
  int inside = 0, cut = 0;
  for (int k = 0; k < 5000; ++k) {
    CAPTURE(k);
    const auto area = random_star(random);
    const auto route = random_walk(random);
    const auto speed_mps = k % 20 == 0 ? 0.05 : random.between(0.1, 30);
    const auto expected = reference_s(route, area, speed_mps);
    const auto actual = time_in_area_s(route, area, speed_mps);
    REQUIRE(actual.has_value() == expected.has_value());
    if (!actual)
      continue;
    ++inside;
    if (std::isinf(*expected)) {
      CHECK(*actual == *expected);
      continue;
    }
    cut += *actual < length_m(route) / speed_mps - 1e-9;
    CHECK(std::abs(*actual - *expected) <= 1e-12 * (1 + *expected));
  }
  CHECK(inside > 1000); // neither side of the question is rare
  CHECK(cut > 500);
}
