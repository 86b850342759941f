// How fast a route may be driven where.
#include "planners/speed/speed_envelope.hpp"

#include "tests/planners/usual_drive.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;
using test::town;

namespace {

const comfort_limits params;

} // namespace

TEST_CASE("a straight street without zones is driven at its limit") {
  const auto way = test::straight(300, {{0, 13.9}});
  const speed_envelope envelope{*way, params};
  for (auto s = -10.0; s < 320; s += 7)
    CHECK(envelope.limit_mps(s) == Approx(13.9));
}

TEST_CASE("the envelope never allows more than limits and bends do") {
  for (const auto& way : {test::oval(town), test::s_curve(town)}) {
    const speed_envelope envelope{*way, params};
    for (auto s = 0.0; s < way->length_m(); s += 0.1) {
      const auto v = envelope.limit_mps(s);
      const auto bend = std::abs(way->path().at(s).curvature_1pm);
      REQUIRE(v <= way->limit_mps(s) + 1e-9);
      REQUIRE(v * v * bend < 1.02 * params.max_lateral_accel_mps2);
      REQUIRE(v > 2);
    }
  }
}

TEST_CASE("driving the envelope needs comfortable braking and little jerk") {
  const auto way = test::oval(town);
  const speed_envelope envelope{*way, params};
  constexpr auto dt_s = 0.1;
  auto s = 0.0, accel = envelope.at(0).accel_mps2, jerk = 0.0;
  for (auto i = 0; i < 2000; ++i) {
    const auto v = envelope.limit_mps(s);
    s += v * dt_s;
    const auto a = (envelope.limit_mps(s) - v) / dt_s;
    REQUIRE(a >= -1.1 * params.comfort_decel_mps2);
    REQUIRE(a <= 1.1 * params.max_accel_mps2);
    jerk += (a - accel) * (a - accel);
    accel = a;
  }
  CHECK(std::sqrt(jerk / 2000) / dt_s < params.max_jerk_mps3);
}

TEST_CASE("a closed route's envelope is the same lap after lap") {
  // The slow zone begins behind the seam: braking starts in the lap before.
  const auto way = test::oval({{0, 13.9}, {3, 3.0}, {60, 13.9}});
  const speed_envelope envelope{*way, params};
  const auto length_m = way->length_m();
  for (auto s = 0.0; s < length_m; s += 11)
    CHECK(envelope.limit_mps(s + 3 * length_m)
          == Approx(envelope.limit_mps(s)).epsilon(1e-6));
  CHECK(envelope.limit_mps(length_m - 1e-9)
        == Approx(envelope.limit_mps(length_m + 1e-9)));
  CHECK(envelope.at(length_m - 1).accel_mps2 < 0);
}

TEST_CASE("the acceleration belongs to the speed") {
  const auto way = test::oval(town);
  const speed_envelope envelope{*way, params};
  auto speed = envelope.limit_mps(0);
  for (auto s = 0.0; s < way->length_m(); s += 0.05) {
    const auto a = envelope.at(s).accel_mps2;
    speed = std::sqrt(std::max(0.01, speed * speed + 2 * a * 0.05));
    REQUIRE(std::abs(speed - envelope.limit_mps(s + 0.05)) < 0.2);
  }
}
