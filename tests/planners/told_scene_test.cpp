// Who of those that a car sees keeps what it has claimed.
#include "planners/scene/told_scene.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace std::chrono_literals;

namespace {

constexpr time_point now{10s};

/// To the east, at the origin now.
told_drive claimed(double speed_mps) {
  told_drive x{7, {now - 1s, 200ms, {}}, true, {2.5, 0}};
  for (auto t_s = -1.0; t_s < 4; t_s += 0.2)
    x.drive.bodies.push_back({{speed_mps * t_s, 0}, 0, 5, 2});
  return x;
}

/// @returns whether a car that is so far behind what it has claimed is thought
/// to keep it.
bool is_kept(double speed_mps, double behind_m) {
  other_body car;
  car.x.motion.mean.col(0) << -behind_m, 0;
  car.x.motion.mean.col(1) << speed_mps, 0;
  car.x.length_m = 5;
  car.x.width_m = 2;
  car.x.station = station_id{7};
  auto says = claimed(speed_mps);
  says.front = {2.5 - behind_m, 0};
  std::vector others{car};
  find_those_who_tell(now, std::vector{says}, true, others);
  return others[0].has_claimed;
}

} // namespace

TEST_CASE("a slow car that is three metres behind what it has claimed does not "
          "keep it") {
  CHECK(is_kept(2, 2.8));
  CHECK_FALSE(is_kept(2, 3.2));
}

TEST_CASE("a fast car keeps what it has claimed as long as it is not half a "
          "second late") {
  CHECK(is_kept(10, 4.8));
  CHECK_FALSE(is_kept(10, 5.2));
}
