// Moving along and beside the centre line.
#include "planners/scene/lane_motion.hpp"

#include "tests/planners/test_drive.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

TEST_CASE("a step at constant jerk is exact") {
  const auto x = advance({10, 5, 1}, 2, 0.1);
  CHECK(x.accel_mps2 == 2);
  CHECK(x.speed_mps == Approx(5 + 0.1 * 1.5));
  CHECK(x.s_m == Approx(10 + 0.5 + 0.005 + 10 * 0.001 / 6));
}

TEST_CASE("a car that brakes to rest within a step stays where it stops") {
  const auto x = advance({10, 0.1, -2}, -2, 0.1);
  CHECK(x.speed_mps == 0);
  CHECK(x.accel_mps2 == 0);
  CHECK(x.s_m == Approx(10 + 0.01 / 4));
  const auto later = advance(x, -1, 0.1);
  CHECK(later.s_m == x.s_m);
}

TEST_CASE("a returning car's heading and curvature belong to its way") {
  const auto way = test::oval({{0, 13.9}});
  planning_input x;
  x.s_m = 380; // into a bend of 25 m radius
  x.d_m = 0.8;
  x.heading_error_rad = -0.05;
  x.speed_mps = 6;
  const centring line{*way, x, 15};
  const auto at = [&](double ahead_m) {
    return line.place({x.s_m + ahead_m, 6, 0}, 0);
  };
  CHECK(at(0).speed_mps == Approx(6).epsilon(0.1));
  constexpr auto h = 0.01;
  for (auto ahead_m = 0.5; ahead_m < 25; ahead_m += 0.5) {
    const auto a = at(ahead_m - h), b = at(ahead_m), c = at(ahead_m + h);
    const auto way_m = distance_m(a.at, c.at);
    const auto chord = c.at - a.at;
    CHECK(std::atan2(chord.y_m, chord.x_m)
          == Approx(wrap_angle(b.heading_rad)).epsilon(1e-3));
    CHECK(std::abs((c.heading_rad - a.heading_rad) / way_m - b.curvature_1pm)
          < 0.005);
    CHECK(b.speed_mps == Approx(6 * way_m / (2 * h)).epsilon(1e-3));
  }
  const auto back = way->path().project(at(40).at, x.s_m + 40, 5);
  CHECK(std::abs(back.d_m) < 0.02);
}

TEST_CASE("a point of a plan seen from the route is where it was placed") {
  const auto way = test::oval({{0, 13.9}});
  planning_input x;
  x.s_m = way->length_m() + 380;
  x.d_m = -0.3;
  x.heading_error_rad = 0.02;
  x.speed_mps = 6;
  x.accel_mps2 = -1;
  const centring line{*way, x, 15};
  const auto again = seen_from(*way, line.place(line.motion(), 0));
  CHECK(again.s_m == Approx(x.s_m));
  CHECK(again.d_m == Approx(x.d_m));
  CHECK(again.heading_error_rad == Approx(x.heading_error_rad));
  CHECK(again.speed_mps == Approx(x.speed_mps));
  CHECK(again.accel_mps2 == Approx(x.accel_mps2));
}

TEST_CASE("what is moved forward keeps its acceleration, to rest at most") {
  planning_input x;
  x.s_m = 7;
  x.speed_mps = 2;
  x.accel_mps2 = -1;
  const auto soon = moved_forward(x, time_point{from_seconds(0.4)});
  CHECK(soon.speed_mps == Approx(1.6));
  CHECK(soon.s_m == Approx(7 + 0.72));
  const auto later = moved_forward(x, time_point{from_seconds(9)});
  CHECK(later.speed_mps == 0);
  CHECK(later.s_m == Approx(9));
  CHECK(moved_forward(x, time_point{from_seconds(-1)}).s_m == 7);
}
