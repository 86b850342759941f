// Of the conflicts those whose lanes hardly turn against each other.
#include "world/roads/lane_overlaps.hpp"

#include <cmath>
#include <numbers>

namespace sofof::world {

namespace {

constexpr double least_stretch_m = 10;
constexpr double most_turn_rad = std::numbers::pi / 12; // 15°

} // namespace

std::vector<lane_overlap> lane_overlaps(const road_map& map) {
  std::vector<lane_overlap> all;
  for (const auto& x : map.conflicts()) {
    const auto length_m = x.to_a_m - x.from_a_m - 2 * meeting_margin_m;
    if (x.how != conflict::kind::crossing || length_m < least_stretch_m)
      continue;
    const path a{map.lanes()[x.lane_a].centre};
    const path b{map.lanes()[x.lane_b].centre};
    const auto on_a = a.at((x.from_a_m + x.to_a_m) / 2);
    const auto on_b = b.at((x.from_b_m + x.to_b_m) / 2);
    const auto turn_rad =
        std::abs(wrap_angle(on_a.heading_rad - on_b.heading_rad));
    const auto oncoming = turn_rad > std::numbers::pi - most_turn_rad;
    if (oncoming || turn_rad < most_turn_rad)
      all.push_back({x.lane_a, x.lane_b, on_a.at, length_m, oncoming});
  }
  return all;
}

} // namespace sofof::world
