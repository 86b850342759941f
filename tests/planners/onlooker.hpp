// A vehicle that looks round, for tests of what the road means to it.
#pragma once

#include "planners/scene/scene_interpreter.hpp"
#include "tests/support/map_file.hpp"
#include "tests/support/toy_streets.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace sofof::test {

using namespace planners;
using namespace world;

inline constexpr time_point look_time{std::chrono::seconds{50}};
inline const world::vehicle_params car_params;

inline track seen_track(point centre, double heading_rad = 0,
                        double speed_mps = 0) {
  track x;
  x.at = x.seen = look_time;
  x.motion.mean << centre.x_m, speed_mps * std::cos(heading_rad), centre.y_m,
      speed_mps * std::sin(heading_rad);
  x.heading_rad = heading_rad;
  x.length_m = 5.1;
  x.width_m = 1.89;
  return x;
}

/// A car whose rear axle is on a way.
inline track on_way(const route& way, double s_m, double speed_mps = 0) {
  const auto here = way.path().at(s_m);
  vehicle_state x;
  x.at = here.at;
  x.heading_rad = here.heading_rad;
  return seen_track(body(x, car_params).centre, x.heading_rad, speed_mps);
}

/// A route as those know it who look round on it.
inline known_way_ptr look_at(const road_map& map, const route_ptr& route) {
  return std::make_shared<const known_way>(
      std::make_shared<const lane_network>(map), route);
}

/// A vehicle that looks round.
struct onlooker {
  onlooker(const road_map& map, route_ptr route, scene_params params = {})
      : way{route}, eyes{look_at(map, route), params} {}

  const driving_scene& look(const std::vector<track>& tracks,
                            time_point at = look_time) {
    eyes.describe(at, me, tracks, seen);
    return seen;
  }

  route_ptr way;
  scene_interpreter eyes;
  own_place me;
  driving_scene seen;
};

/// A lane due east, 3.5 m wide.
inline const road_map& east_street() {
  static const road_map map{
      "street", {}, {toy::straight("lane", {0, 0}, {400, 0})}};
  return map;
}

inline onlooker on_street(scene_params params = {}) {
  const std::vector<std::string> lanes{"lane"};
  return {east_street(), east_street().make_route("lane", lanes, false),
          params};
}

/// Own rear axle at 10 m, so the front at 14.0175 m.
inline onlooker ten_metres_down_the_street() {
  auto o = on_street();
  o.me.s_m = 10;
  return o;
}

inline const auto& lehr() {
  static const auto file =
      test::read_map(SOFOF_SOURCE_DIR "/config/maps/ulm_lehr.toml");
  return file;
}

inline const std::string round_trips[]{"round_trip", "round_trip_opposite"};

} // namespace sofof::test
