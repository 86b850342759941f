// A vehicle that judges the scenes which it is told.
#pragma once

#include "planners/judges/scene_judge.hpp"
#include "tests/planners/onlooker.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::test {

inline route_ptr judged_street() {
  const road_map map{
      "street", {}, {toy::straight("street", {0, 0}, {2000, 0})}};
  return map.make_route("street", std::vector<std::string>{"street"}, false);
}

/// A vehicle at 200 m of a straight street, which is told its scene every
/// 100 ms.
struct told_drive_of_scenes {
  route_ptr way = judged_street();
  time_point now{look_time};
  double speed_mps = 8;
  driving_scene own;  ///< Of what it knows.
  driving_scene told; ///< As it is used in the end.
  std::vector<track> tracks;
  std::vector<perceived_object> seen;
  line_of_sight houses;
  scene_judge judge;

  static constexpr double at_m = 200;
  double front_m() const { return at_m + car_params.front_m; }

  static lead_vehicle lead(double rear_m, double speed_mps = 0) {
    lead_vehicle x;
    x.rear_s_m = rear_m;
    x.speed_mps = speed_mps;
    return x;
  }

  scene_verdict step(driving_scene what) {
    own.at = what.at = now;
    told = std::move(what);
    const auto verdict = judge.judge({.now = now,
                                      .way = *way,
                                      .s_m = at_m,
                                      .speed_mps = speed_mps,
                                      .scene = own,
                                      .tracks = tracks,
                                      .look = {now,
                                               {{at_m + 1.5, 0}, 0, 100, 360},
                                               speed_mps,
                                               now,
                                               seen,
                                               {},
                                               seen.size()}},
                                     houses, told);
    now += std::chrono::milliseconds{100};
    return verdict;
  }

  std::optional<std::pair<std::string, double>>
  go_on(double for_s, const driving_scene& what) {
    const auto begin = now;
    while (to_seconds(now - begin) < for_s)
      if (const auto x = step(what).refused)
        return std::pair{std::string{x->check}, to_seconds(now - begin)};
    return std::nullopt;
  }

  /// A body that the vehicle knows, with what it makes of it.
  void know(const track& x) {
    tracks.push_back(x);
    seen.push_back(
        {x.centre(), x.heading_rad, x.speed_mps(), 0, x.length_m, x.width_m});
  }
};

} // namespace sofof::test
