// Paths that continue each other.
#include "planners/path/path_planner.hpp"

#include "tests/planners/random_road.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

namespace {

constexpr path_planner::grid grid{1, 80};

/// The car as it is on its path.
path_start on(const planned_path& path, double s_m) {
  return {s_m, path.at_s(s_m).x};
}

bool same_path(const planned_path& a, const planned_path& b) {
  if (a.start_s_m != b.start_s_m || a.ds_m != b.ds_m || a.size != b.size)
    return false;
  for (auto k = 0; k < a.size; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (a.knots[i].x.d_m != b.knots[i].x.d_m
        || a.knots[i].x.heading_rad != b.knots[i].x.heading_rad
        || a.knots[i].x.curvature_1pm != b.knots[i].x.curvature_1pm
        || a.knots[i].way_m != b.knots[i].way_m)
      return false;
  }
  return true;
}

/// Whether a car on the path touches a body on a straight road.
bool touches(const planned_path& path, const lane_obstacle& body,
             double gap_m = 0) {
  const oriented_box other{
      {(body.from_m + body.to_m) / 2, (body.low_m + body.high_m) / 2},
      0,
      body.to_m - body.from_m,
      body.high_m - body.low_m + 2 * gap_m};
  for (auto s = path.start_s_m; s < path.end_s_m(); s += 0.1) {
    const auto x = path.at_s(s).x;
    const point along{std::cos(x.heading_rad), std::sin(x.heading_rad)};
    constexpr auto middle_m = (4.0175 - 1.0825) / 2;
    if (overlap({point{s, x.d_m} + middle_m * along, x.heading_rad, 5.1, 1.89},
                other))
      return true;
  }
  return false;
}

} // namespace

TEST_CASE("from anywhere near its lane the car finds a path, which begins "
          "where it is and comes back into the lane") {
  test::dice dice{1};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto way = test::random_road(seed);
    const reference_line line{way};
    path_planner planner{line, grid};
    CHECK(planner.path().empty());
    const path_start car{dice.between(10, 350),
                         {dice.between(-0.8, 0.8), dice.between(-0.1, 0.1), 0}};
    CAPTURE(seed);
    CAPTURE(car.s_m);
    CAPTURE(car.x.d_m);
    CAPTURE(car.x.heading_rad);
    const auto report = planner.plan(car, {});
    CHECK(report.violation < 0.1);
    REQUIRE(planner.settled());
    const auto& path = planner.path();
    CHECK(path.start_s_m == car.s_m);
    CHECK(path.knots[0].x.d_m == car.x.d_m);
    CHECK(path.knots[0].x.heading_rad == car.x.heading_rad);
    CHECK(path.end_s_m() == Approx(car.s_m + 80));
    CHECK(planner.follows(car));
    for (auto k = 1; k < path.size; ++k) {
      const auto& x = path.knots[static_cast<std::size_t>(k)].x;
      CHECK(std::abs(x.curvature_1pm) < 0.201);
      const auto& last = path.knots[static_cast<std::size_t>(k) - 1].x;
      CHECK(std::abs(x.curvature_1pm - last.curvature_1pm) < 0.101);
      if (k >= 25)
        CHECK(std::abs(x.d_m) < corridor::freedom_m + 1e-3);
    }
  }
}

TEST_CASE("on the way the path below the car never jumps, and what follows "
          "hardly changes") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto way = test::random_road(seed);
    const reference_line line{way};
    path_planner planner{line, grid};
    planner.plan({5, {0.3, 0.02, 0}}, {});
    REQUIRE(planner.settled());
    test::dice dice{seed};
    for (auto s = 5.0; s < 380; s += dice.between(0, 1.2)) {
      const auto before = planner.path();
      planner.plan(on(before, s), {});
      const auto& now = planner.path();
      CAPTURE(seed);
      CAPTURE(s);
      REQUIRE(planner.settled());
      REQUIRE(now.start_s_m <= s);
      REQUIRE(now.end_s_m() >= s + 80);
      for (auto ahead = 0.0; ahead < 0.99; ahead += 0.1) {
        const auto a = before.at_s(s + ahead).x, b = now.at_s(s + ahead).x;
        // Up to the next knot it stays; behind it changes by little.
        const auto tolerance =
            std::floor(s + ahead - 5) == std::floor(s - 5) ? 1e-9 : 2e-3;
        REQUIRE(std::abs(a.d_m - b.d_m) < tolerance);
        REQUIRE(std::abs(a.heading_rad - b.heading_rad) < tolerance);
        REQUIRE(std::abs(a.curvature_1pm - b.curvature_1pm) < tolerance);
      }
      for (const auto ahead : {10.0, 30.0})
        REQUIRE(
            std::abs(before.at_s(s + ahead).x.d_m - now.at_s(s + ahead).x.d_m)
            < 0.05);
    }
  }
}

TEST_CASE("nothing happens while the car stays between two knots") {
  const reference_line line{test::random_road(2)};
  path_planner planner{line, grid};
  planner.plan({20, {}}, {});
  planner.plan(on(planner.path(), 20.1), {});
  const auto before = planner.path();
  for (const auto s : {20.2, 20.5, 20.9, 20.3}) {
    planner.plan(on(before, s), {});
    CHECK(same_path(before, planner.path()));
  }
  planner.plan(on(before, 21.1), {});
  CHECK(!same_path(before, planner.path()));
}

TEST_CASE("a car that is off its path begins a new one where it is") {
  const reference_line line{test::random_road(2)};
  path_planner planner{line, grid};
  planner.plan({20, {}}, {});
  for (const auto& car :
       {path_start{24, {0.5, 0, 0}}, path_start{24, {0.1, 0.15, 0}},
        path_start{200, {0, 0, 0}}, path_start{30, {0, 0, 0}}}) {
    CAPTURE(car.s_m);
    CHECK(!planner.follows(car));
    planner.plan(car, {});
    REQUIRE(planner.settled());
    CHECK(planner.follows(car));
    CHECK(planner.path().at_s(car.s_m).x.d_m == Approx(car.x.d_m));
    CHECK(planner.path().at_s(car.s_m).x.heading_rad
          == Approx(car.x.heading_rad));
  }
}

TEST_CASE("a path passes a body on the side it was told, at a distance") {
  const reference_line line{test::straight(300, {{0, 14}})};
  test::dice dice{3};
  for (auto i = 0; i < 60; ++i) {
    const auto from = dice.between(50, 80);
    const auto edge = dice.between(-1.6, -0.8);
    for (const auto side : {side_of_road::left, side_of_road::right}) {
      const auto left = side == side_of_road::left;
      const lane_obstacle body{from, from + dice.between(1, 15),
                               left ? -2.2 : -edge, left ? edge : 2.2, 0};
      path_planner planner{line, grid};
      planner.plan({dice.between(10, 20), {}}, {});
      REQUIRE(planner.settled());
      const std::array passing{path_planner::passing{body, side}};
      const auto report =
          planner.plan(on(planner.path(), planner.path().start_s_m), passing);
      CAPTURE(edge);
      CAPTURE(body.to_m);
      CHECK(ocp::publishable(report.status));
      CHECK(!touches(planner.path(), body, corridor::passing_gap_m - 0.05));
    }
  }
}

TEST_CASE("where no path fits, the one before stays, and ends earlier") {
  const reference_line line{test::straight(300, {{0, 14}})};
  path_planner planner{line, grid};
  planner.plan({10, {}}, {});
  const auto before = planner.path();
  const std::array blocked{
      path_planner::passing{{60, 65, -1.5, 1.5, 0}, side_of_road::left}};
  for (const auto s : {11.5, 14.2, 17.9}) {
    const auto report = planner.plan(on(before, s), blocked);
    CHECK(!ocp::publishable(report.status));
    CHECK(!planner.settled());
    CHECK(same_path(before, planner.path()));
  }
  planner.plan(on(before, 18.4), {});
  CHECK(planner.settled());
  CHECK(planner.path().end_s_m() > before.end_s_m());
}

TEST_CASE("without time there is no path, or the one before") {
  const reference_line line{test::random_road(4)};
  path_planner planner{line, grid};
  const auto never = [](int) noexcept { return false; };
  const ocp::budget none{never};
  CHECK(planner.plan({20, {0.3, 0, 0}}, {}, none).status
        == ocp::solve_status::budget);
  CHECK(planner.path().empty());
  planner.plan({20, {0.3, 0, 0}}, {});
  REQUIRE(planner.settled());
  const auto before = planner.path();
  planner.plan(on(before, 23), {}, none);
  const auto stays = same_path(before, planner.path());
  CHECK((planner.settled() || stays));
}

TEST_CASE("a car whose numbers are none gets no path, and the next one does") {
  const reference_line line{test::random_road(4)};
  path_planner planner{line, grid};
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& car :
       {path_start{nan, {}}, path_start{20, {nan, 0, 0}},
        path_start{20, {0, nan, 0}}, path_start{20, {0, 0, nan}}}) {
    planner.plan(car, {});
    CHECK(!planner.settled());
    CHECK(planner.path().empty());
  }
  planner.plan({20, {}}, {});
  CHECK(planner.settled());
}
