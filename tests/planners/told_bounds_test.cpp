// What a car ahead tells of its drive, as bounds of the own speeds.
#include "planners/trajectory/told_bounds.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace sofof;
using namespace sofof::planners;

namespace {

constexpr double own_front_m = 4;

double way(double s_m) {
  return s_m - 70; // the own rear axle is there
}

} // namespace

TEST_CASE("where a lead tells to stand nobody passes until it goes on") {
  // It stops within less than what two bounds are apart.
  const std::array told{way_moment{94.0, 0}, way_moment{96.4, 0.6},
                        way_moment{97.0, 1.0}, way_moment{97.2, 5.6}};
  told_bounds bounds;
  speed_constraints task;
  bounds.follow(told, 0, own_front_m, way, task);
  REQUIRE_FALSE(task.windows.empty());
  const auto& last = task.windows.back();
  CHECK(last.earliest_s > 5.6);
  CHECK(last.at_m < 97.2 - 70 - own_front_m);
}

TEST_CASE("a lead whose places are all too close is followed as it is seen") {
  const std::array told{way_moment{74.5, 0}, way_moment{75.2, 1.0}};
  told_bounds bounds;
  speed_constraints task;
  task.ahead = {1.0, {}};
  bounds.follow(told, 0, own_front_m, way, task);
  CHECK(task.ahead);
  CHECK(task.windows.empty());
}

TEST_CASE("who stands farther than its drive waits does not creep on") {
  told_bounds bounds;
  agreed_drive waiting;
  waiting.waits_at_m = 69; // a metre behind its rear axle
  speed_constraints task;
  bounds.keep_to(waiting, 0, way, task);
  CHECK(task.stop_m == 0);

  waiting.waits_at_m = 75;
  task = {};
  bounds.keep_to(waiting, 0, way, task);
  CHECK(task.stop_m > 5);
  CHECK(task.stop_m < 6);
}
