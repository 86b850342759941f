// What a sensor sees: range, field of view, what hides what, and noise.
#include "world/sensing/sensors.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace sofof;
using namespace sofof::world;
using std::numbers::pi;

namespace {

/// A sensor at the origin that looks east and makes no errors.
sensor exact() {
  sensor s;
  s.can.position_noise_m = s.can.speed_noise_mps = s.can.heading_noise_rad = 0;
  return s;
}

/// A car of 4 m by 2 m.
road_body small_car(station_id id, point at, double heading_rad = 0) {
  return {id, {at, heading_rad, 4, 2}, 10, -1};
}

building house(point middle, double half_m) {
  return {{middle + point{-half_m, -half_m}, middle + point{half_m, -half_m},
           middle + point{half_m, half_m}, middle + point{-half_m, half_m}}};
}

std::vector<point> places(const sensor& s, std::vector<road_body> bodies,
                          std::vector<building> buildings = {}) {
  scene all{buildings};
  all.place(bodies);
  std::vector<point> found;
  for (const auto& object : all.seen_by(s, {}))
    found.push_back(object.centre);
  return found;
}

bool sees(const sensor& s, std::vector<road_body> bodies,
          std::vector<building> buildings = {}) {
  const auto target = bodies.front().box.centre;
  const auto found = places(s, std::move(bodies), std::move(buildings));
  return std::ranges::find(found, target) != found.end();
}

} // namespace

TEST_CASE("without noise a body is seen as it is") {
  scene all;
  all.place(std::vector{road_body{7, {{20, 3}, 0.5, 4.5, 1.8}, 8, -2}});
  const auto seen = all.seen_by(exact(), {});
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].centre == point{20, 3});
  CHECK(seen[0].heading_rad == 0.5);
  CHECK(seen[0].speed_mps == 8);
  CHECK(seen[0].accel_mps2 == -2);
  CHECK(seen[0].length_m == 4.5);
  CHECK(seen[0].width_m == 1.8);
}

TEST_CASE("the range reaches to the middle of a body") {
  auto s = exact();
  s.can.range_m = 50;
  CHECK(sees(s, {small_car(1, {50, 0})}));
  CHECK_FALSE(sees(s, {small_car(1, {50.01, 0})}));
  CHECK(sees(s, {small_car(1, {-30, 40})}));
  CHECK_FALSE(sees(s, {small_car(1, {-30.01, -40})}));
}

TEST_CASE("a sensor may stand anywhere on the map") {
  auto s = exact();
  for (const auto at : {point{1e5, -1e5}, point{-49.9, 49.9}, point{0, -50}}) {
    s.at = at;
    CHECK(sees(s, {small_car(1, at + point{99, 0})}));
    CHECK(sees(s, {small_car(1, at + point{0, -99})}));
    CHECK_FALSE(sees(s, {small_car(1, at + point{-71, 71})}));
  }
}

TEST_CASE("the field of view lies round the heading") {
  auto s = exact();
  s.can.field_of_view_deg = 90;
  CHECK(sees(s, {small_car(1, {20, 19})}));
  CHECK(sees(s, {small_car(1, {20, -19})}));
  CHECK_FALSE(sees(s, {small_car(1, {20, 24})}));
  CHECK_FALSE(sees(s, {small_car(1, {-20, 0})}));
  s.heading_rad = pi; // over the seam of the angles
  CHECK(sees(s, {small_car(1, {-20, 19})}));
  CHECK(sees(s, {small_car(1, {-20, -19})}));
  CHECK_FALSE(sees(s, {small_car(1, {20, 0})}));
}

TEST_CASE("what reaches into the field of view is seen, wherever its middle") {
  auto s = exact();
  s.can.field_of_view_deg = 180;
  const road_body fence{1, {{-10, 2}, 0, 28.9, 0.6}, 0, 0};
  const road_body farther_back{1, {{-15, 2}, 0, 28.9, 0.6}, 0, 0};
  CHECK(sees(s, {fence}));
  CHECK_FALSE(sees(s, {farther_back}));
  CHECK_FALSE(sees(s, {fence, small_car(2, {2.3, 1})})); // hides that end
}

TEST_CASE("a building hides what is behind it, and nothing else") {
  const auto s = exact();
  const std::vector buildings{house({20, 0}, 5)};
  CHECK_FALSE(sees(s, {small_car(1, {40, 0})}, buildings));
  CHECK(sees(s, {small_car(1, {40, 0})}));
  CHECK(sees(s, {small_car(1, {10, 0})}, buildings));
  CHECK(sees(s, {small_car(1, {40, 20})}, buildings));
  CHECK(sees(s, {small_car(1, {-40, 0})}, buildings));
}

TEST_CASE("one corner round the house is enough to be seen") {
  const auto s = exact();
  // In its shadow |y| < x / 3; the car's rear corner is at x = 29.
  const std::vector buildings{house({20, 0}, 5)};
  CHECK_FALSE(sees(s, {small_car(1, {30, 7.6}, pi / 2)}, buildings));
  CHECK(sees(s, {small_car(1, {30, 7.7}, pi / 2)}, buildings));
}

TEST_CASE("a gap that shows only the middle is enough, too") {
  const auto s = exact();
  const auto across = small_car(1, {30, 0}, pi / 2);
  CHECK(sees(s, {across}, {house({15, 5.5}, 5), house({15, -5.5}, 5)}));
  CHECK_FALSE(sees(s, {across}, {house({15, 5.5}, 5), house({15, -4.5}, 5)}));
}

TEST_CASE("a house whose middle is far away hides too") {
  auto s = exact();
  s.can.range_m = 30;
  CHECK_FALSE(sees(s, {small_car(1, {25, 0})}, {house({1015, 0}, 1000)}));
  CHECK(sees(s, {small_car(1, {25, 0})}, {house({1040, 0}, 1000)}));
}

TEST_CASE("a house hides along its diagonal, corner to corner") {
  CHECK_FALSE(
      sees(exact(), {small_car(1, {40, 40}, pi / 4)}, {house({20, 20}, 5)}));
}

TEST_CASE("a car hides the one behind it as long as it covers all of it") {
  const auto s = exact();
  CHECK(places(s, {small_car(1, {30, 0}), small_car(2, {10, 0})})
        == std::vector{point{10, 0}});
  CHECK(sees(s, {small_car(1, {30, 3}), small_car(2, {10, 0})})); // looks out
  CHECK(sees(s, {small_car(1, {5, 0}), small_car(2, {15, 0})}));
}

TEST_CASE("a lorry whose middle is out of range hides too") {
  auto s = exact();
  s.can.range_m = 20;
  const road_body lorry{2, {{15, 12}, pi / 2, 30, 2.5}, 0, 0};
  REQUIRE(distance_m({}, lorry.box.centre) < 20);
  CHECK_FALSE(sees(s, {small_car(1, {19, 0}), lorry}));
  const road_body longer{2, {{15, 22}, pi / 2, 50, 2.5}, 0, 0};
  REQUIRE(distance_m({}, longer.box.centre) > 20);
  CHECK_FALSE(sees(s, {small_car(1, {19, 0}), longer}));
}

TEST_CASE("a sensor can be told to look through everything") {
  auto s = exact();
  s.can.occlusion = false;
  CHECK(places(s, {small_car(1, {30, 0}), small_car(2, {10, 0})},
               {house({20, 0}, 5)})
            .size()
        == 2);
}

TEST_CASE("what carries the sensor is not seen, and hides nothing") {
  auto s = exact();
  s.carrier = 9;
  const auto seen = places(s, {small_car(9, {0, 0}), small_car(1, {20, 0})});
  CHECK(seen == std::vector{point{20, 0}});
}

TEST_CASE("a sensor on a mast sees who passes below, and past it") {
  CHECK(places(exact(), {small_car(1, {20, 0}), small_car(2, {0.5, 0})})
        == std::vector{point{0.5, 0}, point{20, 0}});
  CHECK(
      sees(exact(), {small_car(1, {20, 0})}, {house({0, 0}, 5)})); // on a roof
}

TEST_CASE("the nearest comes first, and of two equally far the lower id") {
  CHECK(
      places(exact(), {small_car(4, {0, 30}), small_car(3, {0, -20}),
                       small_car(2, {-20, 0}), small_car(1, {10, 0})})
      == std::vector{point{10, 0}, point{-20, 0}, point{0, -20}, point{0, 30}});
}

TEST_CASE("whom one sees does not depend on the order of the bodies") {
  const auto s = exact();
  CHECK(places(s, {small_car(1, {10, 0}), small_car(2, {30, 1}),
                   small_car(3, {0, 80})})
        == places(s, {small_car(3, {0, 80}), small_car(2, {30, 1}),
                      small_car(1, {10, 0})}));
}

TEST_CASE("who has gone is seen no more") {
  scene all;
  all.place(std::vector{small_car(1, {20, 0}), small_car(2, {0, 20})});
  REQUIRE(all.seen_by(exact(), {}).size() == 2);
  all.place(std::vector{small_car(2, {0, 20})});
  const auto seen = all.seen_by(exact(), {});
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].centre == point{0, 20});
}

TEST_CASE("noise has the spread that was asked for, and no bias") {
  sensor s;
  s.noise = random_stream{5, "sensors"};
  s.can.position_noise_m = 0.3;
  s.can.speed_noise_mps = 0.2;
  s.can.heading_noise_rad = 0.05;
  scene all;
  all.place(std::vector{small_car(1, {20, 5}, pi)});
  constexpr auto count = 20000;
  double sums[4] = {}, squares[4] = {}, mixed = 0;
  for (int k = 0; k < count; ++k) {
    const auto seen =
        all.seen_by(s, time_point{std::chrono::milliseconds{50} * k});
    REQUIRE(seen.size() == 1);
    const auto& o = seen.front();
    CHECK(std::abs(o.heading_rad) <= pi);
    CHECK(o.length_m == 4);
    CHECK(o.accel_mps2 == -1);
    const double errors[4] = {o.centre.x_m - 20, o.centre.y_m - 5,
                              o.speed_mps - 10, wrap_angle(o.heading_rad - pi)};
    for (int i = 0; i < 4; ++i) {
      sums[i] += errors[i];
      squares[i] += errors[i] * errors[i];
    }
    mixed += errors[0] * errors[1];
  }
  const double sd[4] = {0.3, 0.3, 0.2, 0.05};
  for (int i = 0; i < 4; ++i) {
    CHECK(std::abs(sums[i] / count) < 4 * sd[i] / std::sqrt(count));
    CHECK(std::sqrt(squares[i] / count) == test::near(sd[i], 0.02));
  }
  CHECK(std::abs(mixed / count) < 4 * 0.09 / std::sqrt(count));
}

TEST_CASE("noise is the same again, and another for others and later") {
  const auto see = [](std::uint64_t seed, station_id who, int ms,
                      std::vector<road_body> others = {}) {
    sensor s;
    s.noise = random_stream{seed, "sensors"}.part(100);
    others.push_back(small_car(who, {20, 0}));
    scene all;
    all.place(others);
    return all.seen_by(s, time_point{std::chrono::milliseconds{ms}})
        .front()
        .centre;
  };
  CHECK(see(1, 1, 50) == see(1, 1, 50));
  CHECK(see(1, 1, 50)
        == see(1, 1, 50, {small_car(2, {0, 30}), small_car(3, {40, 9})}));
  CHECK_FALSE(see(1, 1, 50) == see(2, 1, 50));
  CHECK_FALSE(see(1, 1, 50) == see(1, 2, 50));
  CHECK_FALSE(see(1, 1, 50) == see(1, 1, 100));
}

TEST_CASE("a sensor sees what a slow look at all pairs sees") {
  const random_stream draw{3, "town"};
  std::vector<road_body> bodies;
  std::vector<building> buildings;
  for (station_id::rep i = 1; i <= 60; ++i)
    bodies.push_back(small_car(
        i, {draw.uniform(-120, 120, i, 0), draw.uniform(-120, 120, i, 1)},
        draw.uniform(-pi, pi, i, 2)));
  for (std::uint64_t i = 0; i < 12; ++i)
    buildings.push_back(
        house({draw.uniform(-120, 120, i, 3), draw.uniform(-120, 120, i, 4)},
              draw.uniform(2, 12, i, 5)));
  // Points along the line, each asked whether it is in something.
  const auto clear = [&](point a, point b, station_id not_in) {
    constexpr auto steps = 4000;
    for (int k = 0; k <= steps; ++k) {
      const auto p = a + static_cast<double>(k) / steps * (b - a);
      for (const auto& h : buildings)
        if (polygon{h.corners}.contains(p))
          return false;
      for (const auto& other : bodies)
        if (other.id != not_in && overlap(other.box, {p}))
          return false;
    }
    return true;
  };
  const auto s = exact();
  const auto found = places(s, bodies, buildings);
  auto hidden = 0;
  for (const auto& target : bodies) {
    const auto& box = target.box;
    const point along{std::cos(box.heading_rad), std::sin(box.heading_rad)};
    const point left{-along.y_m, along.x_m};
    std::vector points{box.centre};
    for (const auto x_m : {-2, 2})
      for (const auto y_m : {-1, 1})
        points.push_back(box.centre + x_m * along + y_m * left);
    const auto in_range = distance_m(s.at, box.centre) <= s.can.range_m;
    const auto visible = in_range && std::ranges::any_of(points, [&](point p) {
                           return clear(s.at, p, target.id);
                         });
    hidden += in_range && !visible;
    CAPTURE(target.id);
    CHECK((std::ranges::find(found, box.centre) != found.end()) == visible);
  }
  CHECK(found.size() > 5);
  CHECK(hidden > 5);
}
