// Where the corridor lets the car be, and where not.
#include "planners/scene/corridor.hpp"

#include "tests/planners/random_road.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

namespace {

constexpr auto steps = 60;
constexpr auto half_car_m = 0.945;

/// A corridor, and the lane that it is of.
struct lane_with_bodies : corridor {
  lane_bounds lane;

  void open(const reference_line& line, double s_m, double ds_m, int count) {
    lane.move(line, s_m, ds_m, count);
    corridor::open(lane);
  }
};

bool holds(const corridor& room, double d_m, double heading_rad) {
  const std::vector<double> d(steps + 1, d_m), heading(steps + 1, heading_rad);
  return room.contains(d, heading, 0);
}

/// Between which offsets a car that stands straight may be at a knot.
std::pair<double, double> straight_room(const corridor& room, std::size_t k) {
  auto lo = -std::numeric_limits<double>::infinity(), hi = -lo;
  for (const auto& disc : room.discs()) {
    lo = std::max(lo, disc.lo_m[k]);
    hi = std::min(hi, disc.hi_m[k]);
  }
  return {lo, hi};
}

void check_same(const corridor& a, const corridor& b) {
  REQUIRE(a.discs().size() == b.discs().size());
  for (std::size_t j = 0; j < a.discs().size(); ++j) {
    CHECK(a.discs()[j].ahead_m == b.discs()[j].ahead_m);
    for (std::size_t k = 0; k <= steps; ++k) {
      CHECK(a.discs()[j].lo_m[k] == Approx(b.discs()[j].lo_m[k]));
      CHECK(a.discs()[j].hi_m[k] == Approx(b.discs()[j].hi_m[k]));
    }
  }
}

} // namespace

TEST_CASE("the line itself always fits") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto way = test::random_road(seed, 300, seed % 2 == 0 ? 15 : 6);
    const reference_line line{way};
    lane_with_bodies room;
    room.open(line, 3.3 * static_cast<double>(seed), 1, steps);
    CHECK(holds(room, 0, 0));
  }
}

TEST_CASE("in a free lane the axle keeps near the centre line") {
  const reference_line line{test::straight(200, {{0, 10}})};
  lane_with_bodies room;
  room.open(line, 10, 1, steps);
  CHECK(holds(room, corridor::freedom_m - 0.01, 0));
  CHECK(holds(room, -corridor::freedom_m + 0.01, 0));
  CHECK(!holds(room, corridor::freedom_m + 0.01, 0));
  CHECK(!holds(room, -corridor::freedom_m - 0.01, 0));
}

TEST_CASE("a car that the corridor holds keeps its sides in the lane, in bends "
          "too") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto way = test::random_road(seed, 300);
    const reference_line line{way};
    lane_with_bodies room;
    test::dice dice{seed};
    const auto start = dice.between(5, 200);
    room.open(line, start, 1, steps);
    auto held = 0;
    for (auto i = 0; i < 2000; ++i) {
      const auto k = static_cast<std::size_t>(dice.between(1, steps));
      const auto d = dice.between(-0.5, 0.5), turn = dice.between(-0.2, 0.2);
      auto inside = true;
      for (const auto& disc : room.discs()) {
        const auto y = d + disc.ahead_m * std::sin(turn);
        inside &= y >= disc.lo_m[k] && y <= disc.hi_m[k];
      }
      if (!inside)
        continue;
      ++held;
      const auto s = start + static_cast<double>(k);
      const auto centre = way->path().at(s);
      const auto heading = centre.heading_rad + turn;
      const point along{std::cos(heading), std::sin(heading)};
      const point left{-along.y_m, along.x_m};
      const auto axle = centre.at
                        + d
                              * point{-std::sin(centre.heading_rad),
                                      std::cos(centre.heading_rad)};
      for (const auto x : {-1.0825, 0.0, 2.0, 4.0175})
        for (const auto y : {-half_car_m, half_car_m}) {
          const auto corner =
              way->path().project(axle + x * along + y * left, s + x, 5);
          CAPTURE(s);
          CAPTURE(x);
          // The discs cover the corners but for their arcs.
          CHECK(std::abs(corner.d_m) < 1.75 + 0.03);
        }
    }
    CHECK(held > 100);
  }
}

TEST_CASE("a corridor that moved on is the one of the new place") {
  const auto way = test::random_road(3, 400);
  const reference_line line{way};
  lane_with_bodies moving;
  auto s = 12.25;
  for (const auto by : {0, 1, 3, 0, 59, 60, 61, 17, -5}) {
    s += by;
    moving.open(line, s, 1, steps);
    lane_with_bodies fresh;
    fresh.open(line, s, 1, steps);
    CAPTURE(by);
    check_same(moving, fresh);
    moving.pass({s + 20, s + 25, -1.7, -1.0, 0}, side_of_road::left);
    moving.admit({0.9, 0.1, 0}, corridor::steering::drifts);
  }
  moving.open(line, s + 0.4, 1, steps); // between the old knots
  lane_with_bodies fresh;
  fresh.open(line, s + 0.4, 1, steps);
  check_same(moving, fresh);
}

TEST_CASE("beside a body the car keeps its distance, on the side it was told") {
  const reference_line line{test::straight(200, {{0, 10}})};
  test::dice dice{7};
  for (auto i = 0; i < 200; ++i) {
    const auto from = dice.between(15, 40), length = dice.between(0.3, 12);
    const auto edge = dice.between(-1.7, -0.8);
    for (const auto side : {side_of_road::left, side_of_road::right}) {
      const auto left = side == side_of_road::left;
      const lane_obstacle body{from, from + length, left ? -2.0 : -edge,
                               left ? edge : 2.0, 0};
      lane_with_bodies room;
      room.open(line, 0, 1, steps);
      room.pass(body, side);
      for (std::size_t k = 0; k <= steps; ++k) {
        const auto [lo, hi] = straight_room(room, k);
        CAPTURE(edge);
        CAPTURE(k);
        CHECK(lo <= hi);
        const auto s = static_cast<double>(k);
        if (s + 4.0175 < from || s - 1.0825 > from + length)
          continue; // the car is not beside it
        if (left)
          CHECK(lo - half_car_m >= edge + corridor::passing_gap_m - 0.05);
        else
          CHECK(hi + half_car_m <= -edge - corridor::passing_gap_m + 0.05);
        CHECK(std::abs(left ? hi : lo) + half_car_m <= 1.75);
      }
    }
  }
}

TEST_CASE(
    "in a bend no corner of a car that the corridor holds comes near to a "
    "body, however it stands") {
  const auto turn_left = [](double radius_m) {
    std::vector<point> points;
    for (auto x = -60.0; x < 0; x += 2)
      points.push_back({x, 0});
    for (auto a = 0.0; a < 1.5; a += 0.1)
      points.push_back({radius_m * std::sin(a), radius_m * (1 - std::cos(a))});
    return std::make_shared<const world::route>(
        "bend", std::vector{world::lane{"bend", points, 2.5, {{0, 10}}, {}, 0}},
        std::vector<std::size_t>{0}, false, world::lane_index{});
  };
  test::dice dice{21};
  auto held = 0;
  for (auto i = 0; i < 20'000; ++i) {
    const auto radius = dice.between(9, 20);
    const auto way = turn_left(radius);
    const reference_line line{way};
    const auto from = way->length_m() - 12, edge = dice.between(-2.0, -0.9);
    const auto is_left = dice.between(0, 1) < 0.5; // of a body outside
    const lane_obstacle body{
        from, from + 2, is_left ? -2.5 : -edge,
        is_left ? edge + corridor::swing_m(1 / radius) : 2.5, 0};
    lane_with_bodies room;
    room.open(line, from - 20, 0.5, steps);
    room.pass(body, is_left ? side_of_road::left : side_of_road::right);
    const auto k = static_cast<std::size_t>(dice.between(30, 46));
    const auto d = dice.between(-1, 1), turn = dice.between(-0.15, 0.15);
    if (!std::ranges::all_of(room.discs(), [&](const auto& disc) {
          const auto y = d + disc.ahead_m * std::sin(turn);
          return y >= disc.lo_m[k] && y <= disc.hi_m[k];
        }))
      continue;
    ++held;
    const auto s = from - 20 + 0.5 * static_cast<double>(k);
    const auto here = way->path().at(s);
    const auto heading = here.heading_rad + turn;
    const point along{std::cos(heading), std::sin(heading)};
    const point left{-along.y_m, along.x_m};
    const auto axle =
        here.at
        + d * point{-std::sin(here.heading_rad), std::cos(here.heading_rad)};
    for (auto x = -1.0825; x <= 4.0175; x += 0.3)
      for (const auto y : {-half_car_m, half_car_m}) {
        const auto on = way->path().project(axle + x * along + y * left, s + x);
        if (on.s_m < body.from_m || on.s_m > body.to_m)
          continue;
        CAPTURE(edge);
        CAPTURE(x);
        if (is_left)
          CHECK(on.d_m > edge + 0.05);
        else
          CHECK(on.d_m < -edge - 0.05);
      }
  }
  CHECK(held > 1000);
}

TEST_CASE("between two bodies both keep the car off, whichever comes first") {
  const reference_line line{test::straight(200, {{0, 10}})};
  const lane_obstacle left{30, 34, 0.9, 2, 0}, right{30, 34, -2, -0.9, 0};
  for (const auto left_first : {true, false}) {
    lane_with_bodies room;
    room.open(line, 10, 1, steps);
    if (left_first)
      room.pass(left, side_of_road::right);
    room.pass(right, side_of_road::left);
    if (!left_first)
      room.pass(left, side_of_road::right);
    const auto [lo, hi] = straight_room(room, 19); // beside both
    CHECK(hi < left.low_m - half_car_m);
    CHECK(lo > right.high_m + half_car_m);
  }
}

TEST_CASE("whoever comes too near to a body is let no farther into it") {
  const reference_line line{test::straight(200, {{0, 10}})};
  test::dice dice{9};
  for (auto i = 0; i < 500; ++i) {
    const auto from = dice.between(-3, 12), length = dice.between(0.3, 12);
    const auto edge = dice.between(-1.7, -0.8);
    const path_state car{dice.between(-0.8, 0.8), dice.between(-0.3, 0.3),
                         dice.between(-0.1, 0.1)};
    const auto lacks = dice.between(0, 0.3);
    for (const auto side : {side_of_road::left, side_of_road::right}) {
      const auto left = side == side_of_road::left;
      lane_with_bodies room;
      room.open(line, 0, 1, steps);
      room.pass({from, from + length, left ? -2.0 : -edge, left ? edge : 2.0, 0,
                 lacks},
                side);
      room.admit(
          left ? car
               : path_state{-car.d_m, -car.heading_rad, -car.curvature_1pm},
          corridor::steering::drifts);
      CHECK(room.gap_m() > 0.019);
      for (std::size_t k = 1; k <= steps; ++k) {
        const auto s = static_cast<double>(k);
        if (s + 4.0175 < from || s - 1.0825 > from + length)
          continue; // the car is not beside it
        CAPTURE(edge);
        CAPTURE(k);
        const auto [lo, hi] = straight_room(room, k);
        CHECK((left ? lo : -hi) - half_car_m > edge - 0.04);
      }
    }
  }
}

TEST_CASE("a car that drifts may leave its lane by its discs, not by itself") {
  const reference_line line{test::straight(200, {{0, 10}})};
  test::dice dice{10};
  for (auto i = 0; i < 500; ++i) {
    const path_state car{0, dice.between(-0.2, 0.2), dice.between(-0.2, 0.2)};
    lane_with_bodies room;
    room.open(line, 0, 1, steps);
    room.admit(car, corridor::steering::drifts);
    for (std::size_t j = 1; j < room.discs().size(); ++j) {
      const auto& disc = room.discs()[j];
      if (std::abs(disc.ahead_m * std::sin(car.heading_rad)) > 0.48)
        continue; // it has left already
      for (std::size_t k = 0; k <= steps; ++k) {
        CHECK(disc.hi_m[k] <= 1.75 - 1.27 + 0.15 + 1e-9);
        CHECK(disc.lo_m[k] >= -(1.75 - 1.27 + 0.15) - 1e-9);
      }
    }
  }
}

TEST_CASE("a lane that is blocked on one side stays open on the other, and "
          "one without room is closed") {
  const reference_line line{test::straight(200, {{0, 10}})};
  lane_with_bodies room;
  room.open(line, 0, 1, steps);
  room.pass({30, 35, -2, 1, 0}, side_of_road::left);
  const auto [lo, hi] = straight_room(room, 32);
  CHECK(lo > hi);
}

TEST_CASE("a car outside is let in, and 25 m on all is as before") {
  const auto way = test::random_road(5, 300);
  const reference_line line{way};
  test::dice dice{8};
  for (auto i = 0; i < 200; ++i) {
    const path_state car{dice.between(-1.5, 1.5), dice.between(-0.3, 0.3), 0};
    lane_with_bodies room, free;
    room.open(line, 20, 1, steps);
    free.open(line, 20, 1, steps);
    room.admit(car, corridor::steering::drifts);
    for (std::size_t j = 0; j < room.discs().size(); ++j) {
      const auto &disc = room.discs()[j], &was = free.discs()[j];
      const auto y = car.d_m + disc.ahead_m * std::sin(car.heading_rad);
      CHECK(y >= disc.lo_m[0] - 1e-9);
      CHECK(y <= disc.hi_m[0] + 1e-9);
      for (std::size_t k = 0; k <= steps; ++k) {
        CHECK(disc.lo_m[k] <= was.lo_m[k]);
        CHECK(disc.hi_m[k] >= was.hi_m[k]);
        if (k >= 25) {
          CHECK(disc.lo_m[k] == was.lo_m[k]);
          CHECK(disc.hi_m[k] == was.hi_m[k]);
        }
      }
    }
  }
}
