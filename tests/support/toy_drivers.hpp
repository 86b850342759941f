// Simple drivers for tests: points on rails that obey what they perceive.
#pragma once

#include "tests/support/lane_users.hpp"
#include "world/traffic/traffic.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sofof::toy {

/// What a rider goes by.
struct view {
  std::optional<double> stop_at_m; ///< As in `perception`.
  std::optional<leader> ahead;
  friend bool operator==(const view&, const view&) = default;
};

struct rider {
  world::road_user user;
  double gap_m = 2;      ///< Kept to who stands ahead.
  double stops_at_m = 0; ///< So far before a line.
  std::size_t late = 0;  ///< It acts on perceptions that many steps old.
  double top_mps = 10;
  std::vector<view> seen{};

  bool has_arrived() const {
    return !user.on->closed() && front_m() > user.on->length_m() - 1;
  }
  double front_m() const { return user.s_m + user.front_m; }
};

inline constexpr double step_s = 0.05;

inline void place(world::road_user& user) {
  const auto axle = user.on->path().at(user.s_m);
  const auto forward_m = 0.5 * (user.front_m - user.rear_m);
  user.body = {
      axle.at
          + forward_m
                * point{std::cos(axle.heading_rad), std::sin(axle.heading_rad)},
      axle.heading_rad, user.front_m + user.rear_m, 1.89};
}

inline rider make_rider(station_id station, world::route_ptr on, double s_m,
                        double speed_mps = 0) {
  rider r;
  r.user.station = station;
  r.user.on = std::move(on);
  r.user.s_m = s_m;
  r.user.speed_mps = speed_mps;
  place(r.user);
  return r;
}

/// @returns the speed from which one can brake to `then_mps` within a
/// distance.
inline double braking_mps(double distance_m, double then_mps = 0) {
  constexpr auto decel_mps2 = 2.0;
  return distance_m <= 0
             ? 0.0
             : std::sqrt(then_mps * then_mps + 2 * decel_mps2 * distance_m);
}

/// @returns the speed that bends and limits allow.
inline double pace_mps(const world::road_user& user) {
  auto pace = 1e300;
  for (auto ahead_m = 0.0; ahead_m < 30; ahead_m += 2) {
    const auto s_m = user.s_m + ahead_m;
    const auto bend_1pm = std::abs(user.on->path().at(s_m).curvature_1pm);
    const auto there =
        std::min(user.on->limit_mps(s_m), std::sqrt(2 / (bend_1pm + 1e-6)));
    pace = std::min(pace, std::sqrt(there * there + 4 * ahead_m));
  }
  return pace;
}

/// Drives one step by what was seen `late` steps ago.
inline void drive(rider& r) {
  auto& u = r.user;
  const auto late = std::min(r.late, r.seen.size() - 1);
  const auto& view = r.seen[r.seen.size() - 1 - late];
  auto wish_mps = std::min(r.top_mps, pace_mps(u));
  if (view.ahead) {
    const auto gap_m = view.ahead->rear_m - r.front_m() - r.gap_m;
    // As fast as would be safe if the one ahead braked at once.
    wish_mps =
        std::min(wish_mps, braking_mps(gap_m, 0.5 * view.ahead->speed_mps));
  }
  if (view.stop_at_m)
    wish_mps = std::min(
        wish_mps, braking_mps(*view.stop_at_m - r.front_m() - r.stops_at_m));
  const auto speed_mps =
      std::max(0.0, std::clamp(wish_mps, u.speed_mps - 6 * step_s,
                               u.speed_mps + 1.5 * step_s));
  u.accel_mps2 = (speed_mps - u.speed_mps) / step_s;
  u.speed_mps = speed_mps;
  u.s_m += speed_mps * step_s;
  place(u);
}

/// Streets with riders on them. Who arrives at the end of its route is taken
/// off the road.
struct town {
  explicit town(world::road_map m) : map{std::move(m)}, all{map}, lanes{map} {}

  /// One step; `backwards` turns the order of the reports around.
  void step(bool backwards = false) {
    std::vector<world::road_user> users;
    for (const auto& r : riders)
      users.push_back(r.user);
    if (backwards)
      std::ranges::reverse(users);
    for (const auto& u : users)
      all.report(u);
    lanes.sort(users);
    now += std::chrono::milliseconds{50};
    all.update(now);
    collisions += all.collisions().size();
    for (auto& r : riders) {
      const auto station = r.user.station;
      r.seen.push_back(
          {all.perceive(station).stop_at_m, lanes.ahead_of(station)});
      if (r.seen.size() > 16)
        r.seen.erase(r.seen.begin());
      drive(r);
    }
    std::erase_if(riders, [&](const rider& r) {
      if (!r.has_arrived())
        return false;
      all.remove(r.user.station);
      return true;
    });
  }

  /// @throws std::out_of_range when it is not (any more) on the road.
  rider& at(station_id station) {
    for (auto& r : riders)
      if (r.user.station == station)
        return r;
    throw std::out_of_range{"no such rider"};
  }

  world::road_map map;
  world::traffic all;
  lane_users lanes;
  std::vector<rider> riders;
  time_point now;
  std::size_t collisions = 0;
};

} // namespace sofof::toy
