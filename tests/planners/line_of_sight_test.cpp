// Buildings hide what is behind them, here as for the sensors of the road.
#include "planners/scene/line_of_sight.hpp"

#include "base/random.hpp"
#include "world/sensing/sensors.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;

namespace {

building house_round(point middle, double width_m, double depth_m) {
  const point half{width_m / 2, depth_m / 2};
  return {{middle + point{-half.x_m, -half.y_m},
           middle + point{half.x_m, -half.y_m}, middle + half,
           middle + point{-half.x_m, half.y_m}}};
}

} // namespace

TEST_CASE("a line is free exactly where a sensor sees") {
  const random_stream dice{7, "houses"};
  auto hidden = 0;
  for (std::uint64_t k = 0; k < 300; ++k) {
    std::vector<building> houses;
    for (std::uint32_t h = 0; h < 6; ++h)
      houses.push_back(house_round({dice.uniform(-80, 80, k, 4 * h),
                                    dice.uniform(-80, 80, k, 4 * h + 1)},
                                   dice.uniform(2, 60, k, 4 * h + 2),
                                   dice.uniform(2, 60, k, 4 * h + 3)));
    const line_of_sight lines{houses};
    scene all{houses};
    sensor eye;
    eye.can.range_m = 500;
    for (std::uint32_t n = 0; n < 20; ++n) {
      eye.at = {dice.uniform(-100, 100, k, 100 + 4 * n),
                dice.uniform(-100, 100, k, 101 + 4 * n)};
      const point p{dice.uniform(-100, 100, k, 102 + 4 * n),
                    dice.uniform(-100, 100, k, 103 + 4 * n)};
      const road_body dot{1, {p, 0, 1e-6, 1e-6}};
      all.place({&dot, 1});
      const auto is_seen = !all.seen_by(eye, {}).empty();
      CHECK(lines.is_free(eye.at, p) == is_seen);
      hidden += is_seen ? 0 : 1;
    }
  }
  CHECK(hidden > 1000);
}

TEST_CASE("a line meets a box that it passes through, begins in, or ends in") {
  const oriented_box box{{10, 0}, 0, 4, 2};
  CHECK(crosses({0, 0}, {20, 0}, box));
  CHECK(crosses({10, 0}, {20, 0}, box));
  CHECK(crosses({0, 0}, {10, 0.5}, box));
  CHECK_FALSE(crosses({0, 0}, {7, 0}, box));
  CHECK_FALSE(crosses({0, 1.5}, {20, 1.5}, box));
}
