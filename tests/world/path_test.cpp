// A smooth line through given points, addressed by arc length.
#include "world/roads/path.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <numbers>
#include <stdexcept>

using namespace sofof;
using namespace sofof::world;
using std::numbers::pi;
using test::dice;

namespace {

std::vector<point> circle_points(double radius_m, int count) {
  std::vector<point> points;
  for (auto i = 0; i < count; ++i) {
    const auto angle = 2 * pi * i / count;
    points.push_back(radius_m * point{std::cos(angle), std::sin(angle)});
  }
  return points;
}

/// A street as people walk it: steps of 6-15 m, turns of up to 0.4 rad.
std::vector<point> wander(dice& d, int count) {
  std::vector<point> points{{d.between(-50, 50), d.between(-50, 50)}};
  auto heading_rad = d.between(-pi, pi);
  for (auto i = 1; i < count; ++i) {
    heading_rad += d.between(-0.4, 0.4);
    points.push_back(
        points.back()
        + d.between(6, 15)
              * point{std::cos(heading_rad), std::sin(heading_rad)});
  }
  return points;
}

/// A bumpy ring.
std::vector<point> bumpy(dice& d) {
  auto points = circle_points(80, 40);
  for (auto& p : points)
    p = p + point{d.between(-1, 1), d.between(-1, 1)};
  return points;
}

/// The nearest of many points along a stretch of path.
double nearest_m(const path& line, point p, double from_m, double to_m) {
  auto nearest = std::numeric_limits<double>::infinity();
  for (auto s_m = from_m; s_m <= to_m; s_m += 0.02)
    nearest = std::min(nearest, distance_m(line.at(s_m).at, p));
  return nearest;
}

} // namespace

TEST_CASE("a path through two points is the straight line") {
  const path line{std::vector<point>{{1, 2}, {31, 42}}};
  CHECK(line.length_m() == doctest::Approx(50));
  const auto half = line.at(25);
  CHECK(half.at.x_m == doctest::Approx(16));
  CHECK(half.at.y_m == doctest::Approx(22));
  CHECK(half.heading_rad == doctest::Approx(std::atan2(4, 3)));
  CHECK(half.curvature_1pm == doctest::Approx(0));
}

TEST_CASE("points in a row make a straight line, however far apart") {
  dice d{7};
  for (auto trial = 0; trial < 50; ++trial) {
    const point from{d.between(-500, 500), d.between(-500, 500)};
    const auto heading_rad = d.between(-pi, pi);
    const point ahead{std::cos(heading_rad), std::sin(heading_rad)};
    std::vector<point> row{from};
    for (auto i = 0; i < 20; ++i)
      row.push_back(row.back() + d.between(0.5, 20) * ahead);
    const path line{row};
    CHECK(line.is_straight());
    CHECK(line.length_m()
          == doctest::Approx(distance_m(row.front(), row.back())));
    for (auto i = 0; i < 50; ++i) {
      const auto s_m = d.between(0, line.length_m()), d_m = d.between(-30, 30);
      const auto here = line.at(s_m);
      CHECK(distance_m(here.at, from + s_m * ahead) < 1e-9);
      CHECK(here.heading_rad == doctest::Approx(heading_rad).epsilon(1e-9));
      CHECK(std::abs(here.curvature_1pm) < 1e-12);
      const auto beside = here.at + d_m * point{-ahead.y_m, ahead.x_m};
      for (const auto guess_m : {s_m, s_m - 8, s_m + 15}) {
        const auto foot = line.project(beside, guess_m);
        CHECK(foot.s_m == doctest::Approx(s_m).epsilon(1e-9));
        CHECK(foot.d_m == doctest::Approx(d_m).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("points that leave the row by a hand, or turn back, bend the line") {
  CHECK(!path{std::vector<point>{{0, 0}, {10, 0.01}, {20, 0}}}.is_straight());
  CHECK(!path{std::vector<point>{{0, 0}, {10, 0}, {8, 0}, {20, 0}}}
             .is_straight());
  CHECK(!path{circle_points(20, 8)}.is_straight());
}

TEST_CASE("a broken list of points is refused") {
  using points = std::vector<point>;
  CHECK_THROWS_AS(path{points{}}, std::invalid_argument);
  CHECK_THROWS_AS(path{points(1)}, std::invalid_argument);
  CHECK_THROWS_AS((path{points{{0, 0}, {1, 0}}, true}), std::invalid_argument);
  CHECK_THROWS_AS((path{points{{0, 0}, {1, 0}, {1, 0}, {2, 0}}}),
                  std::invalid_argument);
  CHECK_THROWS_AS((path{points{{0, 0}, {9, 0}, {9, 9}, {0, 0}}, true}),
                  std::invalid_argument);
  CHECK_NOTHROW((path{points{{0, 0}, {9, 0}, {9, 9}, {0, 0}}}));
}

TEST_CASE("a closed path through a circle's points is that circle") {
  const auto radius_m = 25.0;
  const path ring{circle_points(radius_m, 16), true};
  CHECK(ring.length_m() == doctest::Approx(2 * pi * radius_m).epsilon(1e-4));
  for (auto s_m = -200.0; s_m < 400; s_m += 0.37) {
    const auto here = ring.at(s_m);
    CHECK(distance_m({}, here.at) == doctest::Approx(radius_m).epsilon(1e-4));
    CHECK(here.curvature_1pm == doctest::Approx(1 / radius_m).epsilon(0.02));
    // Continuous over the seam and over laps: one turn a lap.
    const auto turned = 2 * pi * s_m / ring.length_m();
    CHECK(std::abs(here.heading_rad - pi / 2 - turned) < 1e-3);
  }
}

TEST_CASE("a path passes through its points, each at its arc length") {
  dice d{1};
  for (auto n = 0; n < 20; ++n) {
    const auto points = wander(d, 30);
    const path line{points};
    REQUIRE(line.knots_m().size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      CHECK(distance_m(line.at(line.knots_m()[i]).at, points[i]) < 1e-4);
    CHECK(line.knots_m().back() == doctest::Approx(line.length_m()));
  }
}

TEST_CASE("arc length, heading and curvature are one another's derivatives") {
  constexpr auto h = 0.01;
  dice d{2};
  auto check = [&](const path& line) {
    auto pace = 0.0, aim = 0.0, bend = 0.0;
    for (auto i = 0; i < 2000; ++i) {
      const auto s_m = d.between(0, line.length_m() - h);
      const auto here = line.at(s_m), later = line.at(s_m + h);
      const auto step = (1 / h) * (later.at - here.at);
      const auto turned = later.heading_rad - here.heading_rad;
      pace = std::max(pace, std::abs(distance_m({}, step) - 1));
      aim =
          std::max(aim, std::abs(wrap_angle(std::atan2(step.y_m, step.x_m)
                                            - here.heading_rad - turned / 2)));
      bend = std::max(
          bend, std::abs(turned / h
                         - (here.curvature_1pm + later.curvature_1pm) / 2));
    }
    CHECK(pace < 1e-4);
    CHECK(aim < 1e-3);
    CHECK(bend < 5e-3);
  };
  for (auto n = 0; n < 10; ++n) {
    check(path{wander(d, 25)});
    check(path{bumpy(d), true});
  }
}

TEST_CASE("curvature is continuous, also over the seam") {
  dice d{3};
  for (auto n = 0; n < 10; ++n) {
    const path ring{bumpy(d), true};
    auto last = ring.at(-0.01);
    auto jump = 0.0, swerve = 0.0;
    for (auto s_m = 0.0; s_m < ring.length_m() + 1; s_m += 0.01) {
      const auto here = ring.at(s_m);
      jump = std::max(jump, std::abs(here.curvature_1pm - last.curvature_1pm));
      swerve = std::max(swerve, std::abs(here.heading_rad - last.heading_rad));
      last = here;
    }
    CHECK(jump < 1e-3);
    CHECK(swerve < 3e-3);
  }
}

TEST_CASE("open paths clamp, closed ones wrap") {
  const path line{std::vector<point>{{0, 0}, {10, 0}, {20, 5}}};
  CHECK(line.at(-3).at == line.at(0).at);
  CHECK(distance_m(line.at(1e6).at, {20, 5}) < 1e-9);
  CHECK(line.at(0).curvature_1pm == doctest::Approx(0));
  const path ring{circle_points(10, 12), true};
  for (const auto s_m : {0.0, 1.0, 30.0, 62.0})
    for (const auto laps : {-3, 1, 50})
      CHECK(
          distance_m(ring.at(s_m).at, ring.at(s_m + laps * ring.length_m()).at)
          < 1e-6);
}

TEST_CASE("what is put beside a path is found there") {
  dice d{4};
  for (auto n = 0; n < 20; ++n) {
    const path line{wander(d, 40)};
    for (auto i = 0; i < 200; ++i) {
      const auto s_m = d.between(0, line.length_m());
      const auto here = line.at(s_m);
      if (std::abs(here.curvature_1pm) > 0.2)
        continue;
      const auto d_m = d.between(-2, 2);
      const auto p = here.at
                     + d_m
                           * point{-std::sin(here.heading_rad),
                                   std::cos(here.heading_rad)};
      const auto found = line.project(p, s_m + d.between(-3, 3), 5);
      CHECK(std::abs(found.s_m - s_m) < 1e-3);
      CHECK(std::abs(found.d_m - d_m) < 1e-3);
    }
  }
}

TEST_CASE("no point of the path is nearer than the one found") {
  dice d{5};
  for (auto n = 0; n < 20; ++n) {
    const path line{wander(d, 25)};
    for (auto i = 0; i < 10; ++i) {
      const auto guess_m = d.between(0, line.length_m());
      const auto p =
          line.at(guess_m).at + point{d.between(-40, 40), d.between(-40, 40)};
      const auto near = line.project(p, guess_m);
      CHECK(distance_m(line.at(near.s_m).at, p)
            <= nearest_m(line, p, std::max(0.0, guess_m - 20),
                         std::min(line.length_m(), guess_m + 20))
                   + 1e-3);
      CHECK(std::abs(near.s_m - guess_m) <= 20 + 1e-9);
      const auto anywhere = line.project(p);
      CHECK(distance_m(line.at(anywhere.s_m).at, p)
            <= nearest_m(line, p, 0, line.length_m()) + 1e-3);
    }
  }
}

TEST_CASE("a projection counts laps as its guess does") {
  const path ring{circle_points(30, 24), true};
  const auto lap_m = ring.length_m();
  const auto p = ring.at(0.5).at;
  CHECK(ring.project(p, lap_m - 1).s_m == doctest::Approx(lap_m + 0.5));
  CHECK(ring.project(p, 7 * lap_m + 2).s_m == doctest::Approx(7 * lap_m + 0.5));
  CHECK(ring.project(ring.at(-0.5).at, 0.2).s_m == doctest::Approx(-0.5));
  const auto first = ring.project(p);
  CHECK(first.s_m == doctest::Approx(0.5));
  CHECK(std::abs(first.d_m) < 1e-6);
}

TEST_CASE("beyond the end of an open path the offset is from its tangent") {
  const path line{std::vector<point>{{0, 0}, {10, 0}}};
  const auto beyond = line.project({14, 3}, 9);
  CHECK(beyond.s_m == doctest::Approx(10));
  CHECK(beyond.d_m == doctest::Approx(3));
  const auto before = line.project({-4, -1}, 3);
  CHECK(before.s_m == doctest::Approx(0));
  CHECK(before.d_m == doctest::Approx(-1));
}
