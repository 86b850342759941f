// The soonest drive within windows of time.
#include "planners/crossing/window_drive.hpp"

#include "tests/support/dice.hpp"
#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

namespace {

constexpr auto never = std::numeric_limits<double>::infinity();
constexpr double line_m = 110;

const route_profile& straight_on() {
  static const auto map = toy::cross_roads();
  static const route_profile way{toy::make_route(map, {1, 0, 3}),
                                 comfort_limits{}};
  return way;
}

struct windows {
  explicit windows(double way_m)
      : earliest_s(static_cast<std::size_t>(way_m / window_drive::step_m) + 2,
                   -never),
        latest_s(earliest_s.size(), never) {}

  void close_until(double way_m, double t_s) {
    for (auto k = place(way_m); k < earliest_s.size(); ++k)
      earliest_s[k] = std::max(earliest_s[k], t_s);
  }
  void close_from(double way_m, double t_s) {
    for (std::size_t k = 0; k <= place(way_m); ++k)
      latest_s[k] = std::min(latest_s[k], t_s);
  }
  static std::size_t place(double way_m) {
    return static_cast<std::size_t>(std::ceil(way_m / window_drive::step_m));
  }

  std::vector<double> earliest_s, latest_s;
};

window_drive::task task(const windows& in, double s_m, double speed_mps,
                        double accel_mps2 = 0) {
  return {s_m, speed_mps, accel_mps2, line_m, in.earliest_s, in.latest_s};
}

void check_kept(const way_motion& drive, const windows& in, double s_m) {
  for (std::size_t k = 1; k < in.earliest_s.size(); ++k) {
    const auto t =
        drive.time_s(s_m + static_cast<double>(k) * window_drive::step_m);
    CHECK(t >= in.earliest_s[k] - 0.01);
    CHECK(t <= in.latest_s[k] + 0.01);
  }
}

} // namespace

TEST_CASE("a drive without windows is as soon as that of a car alone") {
  window_drive drives{{}};
  for (const auto speed_mps : {3.0, 6.0, 9.0}) {
    CAPTURE(speed_mps);
    const windows open{100};
    way_motion drive;
    REQUIRE(drives.find(straight_on(), task(open, 40, speed_mps), drive));
    const auto alone = drive_freely(straight_on(), {}, 40, speed_mps, 150);
    CHECK(drive.time_s(40) == 0);
    CHECK(drive.time_s(140)
          == Approx(alone.time_s(140)).epsilon(0.05)); // v²/2 has a grid
    CHECK(drive.time_s(140) > alone.time_s(140) - 0.01);
  }
}

TEST_CASE(
    "a place that is closed for a while is waited for on the way, so that "
    "the car drives on at once when it opens") {
  window_drive drives{{}};
  windows some{100};
  some.close_until(70, 20);
  way_motion drive;
  REQUIRE(drives.find(straight_on(), task(some, 40, 9), drive));
  check_kept(drive, some, 40);
  // It does not stand at the line, from where it would take 2 s for 4 m.
  CHECK(drive.time_s(110) < 20.5);
  CHECK(drive.time_s(114) - drive.time_s(110) < 1.2);
}

TEST_CASE("who would have to be past a place sooner than it can has no drive") {
  window_drive drives{{}};
  windows some{100};
  some.close_from(70, 5); // 70 m, at 10 m/s at most
  way_motion drive;
  CHECK_FALSE(drives.find(straight_on(), task(some, 40, 9), drive));
  some = windows{100};
  some.close_from(70, 8);
  CHECK(drives.find(straight_on(), task(some, 40, 9), drive));
  check_kept(drive, some, 40);
}

TEST_CASE("who cannot stop before a closed place any more has no drive") {
  window_drive drives{{}};
  windows some{100};
  some.close_until(10, 30); // from 9 m/s it takes 16 m, braking by 2.5 m/s²
  way_motion drive;
  CHECK_FALSE(drives.find(straight_on(), task(some, 40, 9), drive));
  CHECK(drives.find(straight_on(), task(some, 40, 5), drive));
  check_kept(drive, some, 40);
}

TEST_CASE("acceleration fades out: at first a car drives on as it does") {
  window_drive drives{{}};
  const windows open{100};
  way_motion braking, rolling;
  REQUIRE(drives.find(straight_on(), task(open, 40, 6, -2), braking));
  REQUIRE(drives.find(straight_on(), task(open, 40, 6), rolling));
  CHECK(braking.time_s(46) > rolling.time_s(46) + 0.1);
}

TEST_CASE("drives rise, keep to their windows, and are no faster than cars") {
  window_drive drives{{}};
  test::dice dice{1};
  auto found = 0;
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const auto s_m = dice.between(0, 90), speed_mps = dice.between(0, 10);
    windows some{140 - s_m};
    for (int k = 0; k < 3; ++k) {
      const auto way_m = dice.between(5, 130 - s_m);
      some.close_until(way_m, dice.between(0, 4) * way_m / 8);
    }
    way_motion drive;
    if (!drives.find(straight_on(), task(some, s_m, speed_mps), drive))
      continue;
    ++found;
    check_kept(drive, some, s_m);
    CHECK(drive.begins_m() == s_m);
    auto last_s = -1.0;
    for (auto at = s_m; at <= drive.ends_m(); at += 1) {
      const auto t = drive.time_s(at);
      CHECK(t >= last_s);
      if (at > s_m + 3)
        CHECK(drive.time_s(at) - drive.time_s(at - 2) > 2 / 11.0);
      last_s = t;
    }
  }
  CHECK(found > 200);
}
