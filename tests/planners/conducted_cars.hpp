// Cars at a crossing of four arms that drive exactly as they are told.
#pragma once

#include "planners/crossing/conductor.hpp"
#include "tests/support/toy_streets.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sofof::test {

/// Four arms, whose cars drive exactly as they are told.
struct conducted_cars {
  struct car {
    station_id who;
    planners::route_profile_ptr way;
    double s_m = 0, speed_mps = 0;
    std::optional<world::trajectory> drive;
  };

  conducted_cars()
      : map{toy::cross_roads(true)},
        lanes{std::make_shared<const planners::lane_network>(map)},
        leads{planners::crossing_ways{lanes, {{0, 0}, 80}, body}, {}} {}

  void add(std::uint32_t who, std::size_t in, std::size_t out, double s_m,
           double speed_mps = 0) {
    auto& way = ways[{in, out}];
    if (!way)
      way = std::make_shared<const planners::route_profile>(
          toy::make_route(map, {in, 0, out}), planners::comfort_limits{});
    cars.push_back({station_id{who}, way, s_m, speed_mps, {}});
    std::ranges::sort(cars, {}, &car::who);
  }

  std::vector<planners::crossing_advice> plan() {
    std::vector<planners::approaching_car> all;
    for (const auto& x : cars)
      all.push_back(
          {x.who, x.way, x.s_m, x.speed_mps, 0, true, x.drive, false});
    std::vector<planners::crossing_advice> out;
    leads.plan(now, all, out);
    for (auto& x : cars)
      for (const auto& a : out)
        if (a.who == x.who && !a.drive.empty())
          x.drive = a.drive;
    return out;
  }

  /// Half a second passes; who has come through is gone.
  void go_on() {
    constexpr duration step = std::chrono::milliseconds{100};
    for (int k = 0; k < 5; ++k) {
      now += step;
      for (auto& x : cars) {
        auto s = x.s_m + to_seconds(step) * x.speed_mps;
        if (x.drive && now <= x.drive->end())
          s = std::max(x.s_m, x.drive->at(now).s_m);
        x.speed_mps = (s - x.s_m) / to_seconds(step);
        x.s_m = s;
      }
      for (std::size_t i = 0; i < cars.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          touches += overlap(outline(cars[i]), outline(cars[j]));
      std::erase_if(cars, [&](const car& x) {
        if (!x.drive || now < x.drive->end())
          return false;
        arrived_s[x.who] = to_seconds(now - time_point{});
        return true;
      });
    }
  }

  oriented_box outline(const car& x) const {
    const auto p =
        x.way->line.way().path().at(x.s_m + (body.front_m - body.rear_m) / 2);
    return {p.at, p.heading_rad, body.front_m + body.rear_m, body.width_m};
  }

  world::vehicle_params body;
  world::road_map map;
  std::shared_ptr<const planners::lane_network> lanes;
  planners::conductor leads;
  std::map<std::pair<std::size_t, std::size_t>, planners::route_profile_ptr>
      ways;
  std::vector<car> cars;
  time_point now;
  int touches = 0;
  std::map<station_id, double> arrived_s;
};

} // namespace sofof::test
