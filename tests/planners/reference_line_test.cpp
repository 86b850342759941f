// A route by arc length: curvature, limit and width.
#include "planners/scene/reference_line.hpp"

#include "tests/planners/random_road.hpp"
#include "tests/planners/usual_drive.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;
using test::town;

TEST_CASE("a closed line goes on lap after lap, forwards and backwards") {
  const auto way = test::oval(town);
  const reference_line line{way};
  test::dice dice{1};
  for (auto i = 0; i < 200; ++i) {
    const auto s = dice.between(0, way->length_m());
    CAPTURE(s);
    for (const auto laps : {-2, 1, 7}) {
      const auto there = s + laps * way->length_m();
      CHECK(line.curvature_1pm(there)
            == Approx(line.curvature_1pm(s)).epsilon(1e-9));
      CHECK(line.bow_m(there, 3) == Approx(line.bow_m(s, 3)).epsilon(1e-9));
    }
  }
}

TEST_CASE("an open line stays as at its ends") {
  const auto way = test::random_road(1);
  const reference_line line{way};
  CHECK(line.curvature_1pm(-50) == line.curvature_1pm(0));
  CHECK(line.curvature_1pm(way->length_m() + 50)
        == line.curvature_1pm(way->length_m()));
  CHECK(line.limit_mps(1e6) == line.limit_mps(way->length_m()));
  CHECK(line.half_width_m(-1) == line.half_width_m(0));
}

TEST_CASE("the line has the bends of the route") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto way = test::random_road(seed);
    const reference_line line{way};
    test::dice dice{seed};
    for (auto i = 0; i < 300; ++i) {
      const auto s = dice.between(0, way->length_m());
      CAPTURE(s);
      CHECK(line.curvature_1pm(s) == way->path().at(s).curvature_1pm);
    }
  }
}

TEST_CASE("a place that is no number has no bend, but it has bounds") {
  const auto none = std::numeric_limits<double>::quiet_NaN();
  const auto far = std::numeric_limits<double>::infinity();
  for (const auto& way : {test::random_road(1), test::oval(town)}) {
    const reference_line line{way};
    for (const auto s : {none, far, -far}) {
      CHECK(std::isnan(line.curvature_1pm(s)));
      CHECK(line.limit_mps(s) > 0);
      CHECK(line.half_width_m(s) > 0);
    }
  }
}

TEST_CASE("no place of the line allows more speed than the route, and few "
          "less") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto way = test::random_road(seed);
    const reference_line line{way};
    test::dice dice{seed};
    auto less = 0;
    for (auto i = 0; i < 1000; ++i) {
      const auto s = dice.between(0, way->length_m());
      CAPTURE(s);
      CHECK(line.limit_mps(s) <= way->limit_mps(s));
      CHECK(line.half_width_m(s) <= way->half_width_m(s));
      less += line.limit_mps(s) < way->limit_mps(s) ? 1 : 0;
    }
    CHECK(less < 10); // within a step of a sign
  }
}

TEST_CASE("the line leaves its tangent as the bow says, before and behind") {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto way = test::random_road(seed);
    const reference_line line{way};
    test::dice dice{seed};
    for (auto i = 0; i < 300; ++i) {
      const auto s = dice.between(5, way->length_m() - 5);
      const auto ahead = dice.between(-1.1, 4);
      CAPTURE(s);
      CAPTURE(ahead);
      const auto here = way->path().at(s);
      const auto there = way->path().at(s + ahead);
      const point tangent{std::cos(here.heading_rad),
                          std::sin(here.heading_rad)};
      const auto bow = cross(tangent, there.at - here.at);
      CHECK(std::abs(line.bow_m(s, ahead) - bow) < 0.01);
    }
  }
}
