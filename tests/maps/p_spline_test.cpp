// Smooth curves beside polylines.
#include "maps/p_spline.hpp"

#include "world/roads/path.hpp"

#include <doctest/doctest.h>

#include "maps/polyline.hpp"
#include <algorithm>

using namespace sofof;

TEST_CASE("a smoothed corner stays near its source and bends gently") {
  const std::vector<point> corner{{0, 0}, {30, 0}, {30, 30}};
  const auto curve =
      maps::fit_p_spline(corner, {{0, 0}, {1, 0}, {30, 30}, {0, 1}},
                         {.off_m = 3, .curvature_1pm = 0.19});
  CHECK(curve.sharpest_1pm <= 0.19);
  for (const auto p : curve.points)
    CHECK(maps::distance_to_m(p, corner) <= 3.01);
  CHECK(curve.points.front() == point{0, 0});
  CHECK(curve.points.back() == point{30, 30});
}

TEST_CASE("a straight line stays straight, and needs few points") {
  const std::vector<point> line{{0, 0}, {50, 0}, {200, 0}};
  const auto curve =
      maps::fit_p_spline(line, {{0, 0}, {1, 0}, {200, 0}, {1, 0}}, {});
  CHECK(curve.sharpest_1pm < 1e-6);
  CHECK(maps::thinned(curve.points).size() < 25);
}

TEST_CASE("a spline through the points that are kept is the curve") {
  const std::vector<point> bend{{0, 0}, {40, 0}, {55, 6}, {60, 20}, {60, 60}};
  const auto curve =
      maps::fit_p_spline(bend, {{0, 0}, {1, 0}, {60, 60}, {0, 1}},
                         {.off_m = 1.5, .curvature_1pm = 0.1});
  const world::path kept{maps::thinned(curve.points)};
  for (const auto p : curve.points)
    CHECK(std::abs(kept.project(p).d_m) < 0.03);
}

TEST_CASE("parts of a line fit together") {
  const std::vector<point> line{{0, 0}, {10, 0}, {10, 10}};
  const auto first = maps::part_of(line, 0, 12);
  const auto second = maps::part_of(line, 12, 20);
  CHECK(first.back() == second.front());
  CHECK(first.back() == point{10, 2});
  CHECK(length_m(first) + length_m(second) == doctest::Approx(20));
}
