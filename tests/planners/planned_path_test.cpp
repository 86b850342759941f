// Reading a path: between its knots, along itself and along its line.
#include "planners/path/planned_path.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <type_traits>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

static_assert(std::is_trivially_copyable_v<planned_path>);

namespace {

constexpr double no_bend(double) {
  return 0;
}

/// Swings about a straight line.
planned_path wave(double amplitude_m, double rate_1pm, double ds_m = 1) {
  planned_path path;
  path.start_s_m = 37;
  path.ds_m = ds_m;
  path.size = 81;
  for (auto k = 0; k < path.size; ++k) {
    const auto x = rate_1pm * k * ds_m;
    const auto slope = amplitude_m * rate_1pm * std::cos(x);
    const auto bend = -amplitude_m * rate_1pm * rate_1pm * std::sin(x);
    path.knots[static_cast<std::size_t>(k)].x = {
        amplitude_m * std::sin(x), std::atan(slope),
        bend / std::pow(1 + slope * slope, 1.5)};
  }
  path.measure(no_bend);
  return path;
}

} // namespace

TEST_CASE("a path of fewer than two knots is none") {
  planned_path path;
  CHECK(path.empty());
  path.size = 1;
  CHECK(path.empty());
  CHECK(!wave(1, 0.1).empty());
}

TEST_CASE("at its knots a path is as planned") {
  const auto path = wave(1, 0.1);
  CHECK(path.end_s_m() == Approx(117));
  for (auto k = 0; k < path.size; ++k) {
    const auto& knot = path.knots[static_cast<std::size_t>(k)];
    const auto there = path.at_s(37.0 + k);
    CHECK(there.x.d_m == Approx(knot.x.d_m));
    CHECK(there.x.heading_rad == Approx(knot.x.heading_rad));
    CHECK(there.x.curvature_1pm == Approx(knot.x.curvature_1pm));
    CHECK(path.way_m(there.s_m) == Approx(knot.way_m));
  }
}

TEST_CASE("between its knots a path goes on smoothly, its heading the slope "
          "of its offset") {
  const auto path = wave(1, 0.1);
  test::dice dice{4};
  constexpr auto h = 1e-5;
  for (auto i = 0; i < 500; ++i) {
    const auto s = dice.between(37, 117 - 2 * h);
    CAPTURE(s);
    const auto x = path.at_s(s).x;
    const auto slope = (path.at_s(s + h).x.d_m - path.at_s(s).x.d_m) / h;
    CHECK(std::abs(std::tan(x.heading_rad) - slope) < 2e-3);
    CHECK(std::abs(x.d_m - std::sin(0.1 * (s - 37))) < 1e-4);
    CHECK(path.curvature_1pm(s) == x.curvature_1pm);
  }
}

TEST_CASE("way and arc length tell the same places") {
  const auto path = wave(2, 0.15, 0.7);
  test::dice dice{5};
  for (auto i = 0; i < 500; ++i) {
    const auto way = dice.between(0, path.length_m());
    CAPTURE(way);
    CHECK(path.way_m(path.s_m(way)) == Approx(way));
    CHECK(path.at_way(way).s_m == Approx(path.s_m(way)));
  }
  CHECK(path.s_m(0) == Approx(path.start_s_m));
  CHECK(path.s_m(path.length_m()) == Approx(path.end_s_m()));
}

TEST_CASE("a path that swings is as long as it looks") {
  const auto path = wave(2, 0.15);
  auto length = 0.0;
  constexpr auto step = 0.01;
  for (auto s = path.start_s_m; s < path.end_s_m() - step / 2; s += step)
    length += std::hypot(step, path.at_s(s + step).x.d_m - path.at_s(s).x.d_m);
  CHECK(path.length_m() == Approx(length).epsilon(1e-3));
}

TEST_CASE("inside a bend the way is shorter, outside longer") {
  for (const auto d : {2.0, -2.0}) {
    planned_path path;
    path.ds_m = 0.5;
    path.size = 61;
    for (auto& knot : path.knots)
      knot.x = {d, 0, 1 / (30 - d)};
    path.measure([](double) { return 1.0 / 30; }); // to the left
    CHECK(path.length_m() == Approx(30 * (30 - d) / 30));
    CHECK(path.s_m(path.length_m() / 3) == Approx(10));
  }
}

TEST_CASE("beyond its ends a path stays as at them") {
  const auto path = wave(1, 0.1);
  const auto first = path.at_s(37).x, last = path.at_s(117).x;
  for (const auto by : {0.5, 3.0, 40.0}) {
    const auto before = path.at_s(37 - by), behind = path.at_s(117 + by);
    CHECK(before.x.d_m == Approx(first.d_m));
    CHECK(before.x.heading_rad == Approx(first.heading_rad));
    CHECK(before.x.curvature_1pm == first.curvature_1pm);
    CHECK(behind.s_m == 117 + by);
    CHECK(behind.x.d_m == Approx(last.d_m));
    CHECK(behind.x.heading_rad == Approx(last.heading_rad));
    CHECK(behind.x.curvature_1pm == last.curvature_1pm);
    CHECK(path.way_m(117 + by) > path.length_m());
    CHECK(path.way_m(37 - by) < 0);
  }
}
