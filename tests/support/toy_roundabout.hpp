// A roundabout with four streets to it.
#pragma once

#include "tests/support/toy_streets.hpp"

#include <cmath>
#include <numbers>

namespace sofof::toy {

/// Lanes of equal rank, counterclockwise: "ring K" from the entry of street K
/// to the exit of the next one, "past K" from there to its entry; "from K" and
/// "in K" lead to "ring K", "out K" and "to K" away from where "past K" begins.
inline world::road_map roundabout(double radius_m = 16) {
  constexpr auto quarter = std::numbers::pi / 2, half_gap = 0.4;
  const auto at = [](double r_m, double rad) {
    return r_m * point{std::cos(rad), std::sin(rad)};
  };
  const auto arc = [&](std::string name, double from, double to,
                       std::vector<std::string> next) {
    world::lane l{std::move(name), {}, 1.75, {{0, limit_mps}},
                  std::move(next), 0};
    for (auto i = 0; i <= 8; ++i)
      l.centre.push_back(at(radius_m, from + (to - from) * i / 8));
    return l;
  };
  std::vector<world::lane> lanes;
  for (auto k = 0; k < 4; ++k) {
    const auto next = (k + 1) % 4;
    const auto middle = k * quarter;
    auto past = arc(fmt::format("past {}", k), middle - half_gap,
                    middle + half_gap, {fmt::format("ring {}", k)});
    auto ring =
        arc(fmt::format("ring {}", k), middle + half_gap,
            middle + quarter - half_gap,
            {fmt::format("past {}", next), fmt::format("out {}", next)});
    const auto beside = 2.5 * point{-std::sin(middle), std::cos(middle)};
    auto from =
        straight(fmt::format("from {}", k), at(radius_m + 90, middle) + beside,
                 at(radius_m + 14, middle) + beside);
    auto to =
        straight(fmt::format("to {}", k), at(radius_m + 14, middle) - beside,
                 at(radius_m + 90, middle) - beside);
    // Bends begin and end as the ring does there.
    const auto along = [&](double rad) {
      return straight("", at(radius_m, rad),
                      at(radius_m, rad) + point{-std::sin(rad), std::cos(rad)});
    };
    auto in = bend(fmt::format("in {}", k), from, along(middle + half_gap), 0);
    in.next = {ring.name};
    const auto ends = along(middle - half_gap);
    auto before = ends;
    before.centre = {ends.centre.front()
                         - (ends.centre.back() - ends.centre.front()),
                     ends.centre.front()};
    auto out = bend(fmt::format("out {}", k), before, to, 0);
    from.next = {in.name};
    lanes.insert(lanes.end(), {past, ring, from, in, out, to});
  }
  return {"roundabout", {}, lanes};
}

} // namespace sofof::toy
