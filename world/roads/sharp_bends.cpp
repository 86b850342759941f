// Looks along routes, step by step.
#include "world/roads/sharp_bends.hpp"

#include <algorithm>
#include <cmath>

namespace sofof::world {

namespace {

constexpr double look_every_m = 0.1;
/// A corner of a spline swings before and after it: so far it is one bend.
constexpr double swing_m = 2;

/// @param begin_m, end_m  Between which the route bends too much.
sharp_bend bend_of(const road_map& map, const route& on, double begin_m,
                   double end_m) {
  const auto& path = on.path();
  auto sharpest_m = begin_m;
  for (auto s_m = begin_m; s_m <= end_m; s_m += look_every_m)
    if (std::abs(path.curvature_1pm(s_m))
        > std::abs(path.curvature_1pm(sharpest_m)))
      sharpest_m = s_m;
  const auto turn_rad = path.at(end_m + swing_m).heading_rad
                        - path.at(begin_m - swing_m).heading_rad;
  return {map.lanes()[on.at_lane(sharpest_m).lane].name, path.at(sharpest_m).at,
          std::abs(turn_rad), 1 / std::abs(path.curvature_1pm(sharpest_m))};
}

bool is_same(const sharp_bend& a, const sharp_bend& b) {
  return distance_m(a.at, b.at) < swing_m && a.lane == b.lane;
}

} // namespace

std::vector<sharp_bend> sharp_bends(const road_map& map,
                                    std::span<const route_ptr> routes,
                                    double least_radius_m) {
  std::vector<sharp_bend> all;
  for (const auto& on : routes) {
    auto begin_m = -1.0, end_m = -1.0; // of the bend that we are in
    const auto close = [&] {
      if (begin_m < 0)
        return;
      auto bend = bend_of(map, *on, begin_m, end_m);
      if (std::ranges::none_of(
              all, [&bend](const auto& x) { return is_same(x, bend); }))
        all.push_back(std::move(bend));
      begin_m = -1;
    };
    for (auto s_m = 0.0; s_m <= on->length_m(); s_m += look_every_m) {
      const auto sharp =
          std::abs(on->path().curvature_1pm(s_m)) * least_radius_m > 1;
      if (sharp && begin_m < 0)
        begin_m = s_m;
      if (sharp)
        end_m = s_m;
      else if (begin_m >= 0 && s_m > end_m + swing_m)
        close();
    }
    close();
  }
  return all;
}

} // namespace sofof::world
