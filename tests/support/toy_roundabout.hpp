// A roundabout of four quarters, each with a street in and one out.
#pragma once

#include "tests/support/toy_streets.hpp"

#include <cmath>
#include <numbers>

namespace sofof::toy {

/// Lanes "ring K", "in K" and "out K" of equal rank. "in K" comes to the
/// beginning of "ring K", from outside and to the right of its end; "out K"
/// leaves where that ends.
inline world::road_map roundabout(double radius_m = 16) {
  constexpr auto quarter = std::numbers::pi / 2;
  const auto at = [](double r_m, double rad) {
    return r_m * point{std::cos(rad), std::sin(rad)};
  };
  constexpr auto street_m = 80.0, turned = 0.35;
  std::vector<world::lane> lanes;
  for (auto k = 0; k < 4; ++k) {
    const auto from = k * quarter;
    world::lane ring{fmt::format("ring {}", k), {}, 1.75, {{0, limit_mps}}, {}};
    for (auto i = 0; i <= 8; ++i)
      ring.centre.push_back(at(radius_m, from + quarter * i / 8));
    ring.next = {fmt::format("ring {}", (k + 1) % 4), fmt::format("out {}", k)};
    auto in =
        straight(fmt::format("in {}", k),
                 at(radius_m + street_m, from - turned), at(radius_m, from));
    in.next = {ring.name};
    auto out = straight(fmt::format("out {}", k), at(radius_m, from + quarter),
                        at(radius_m + street_m, from + quarter + turned));
    lanes.insert(lanes.end(), {ring, in, out});
  }
  return {"roundabout", {}, lanes};
}

} // namespace sofof::toy
