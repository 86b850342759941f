// Cars that come to a crossing of four arms, as problems of their order.
#pragma once

#include "planners/crossing/lag.hpp"
#include "planners/crossing/order_problem.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/toy_streets.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace sofof::test {

/// All ways over a crossing of four arms, and where bodies on them meet.
class four_arms {
public:
  static constexpr std::size_t ways = 12;

  four_arms() : map_{toy::cross_roads(true)} {
    constexpr world::moving_body car{5.1 + 0.3, 1.89 + 0.3};
    for (std::size_t in = 1; in <= 4; ++in)
      for (std::size_t out = 1; out <= 4; ++out)
        if (in != out) {
          const auto way = toy::make_route(map_, {in, 0, out});
          lines_m_.push_back(way->start_of_m(1));
          profiles_.emplace_back(way, planners::comfort_limits{});
          arms_.emplace_back(in, out);
        }
    for (std::size_t i = 0; i < ways; ++i)
      for (std::size_t k = 0; k < ways; ++k)
        meet_[i][k] = {all_of(i), car, all_of(k), car};
  }

  const planners::route_profile& way(std::size_t i) const {
    return profiles_[i];
  }
  double line_m(std::size_t i) const { return lines_m_[i]; }
  std::pair<std::size_t, std::size_t> arms(std::size_t i) const {
    return arms_[i];
  }
  const world::meeting_curve& meet(std::size_t i, std::size_t k) const {
    return meet_[i][k];
  }
  planners::kept_apart gap(std::size_t i, std::size_t k) const {
    const planners::lag_margins margins;
    return arms_[i].first == arms_[k].first
                   || arms_[i].second == arms_[k].second
               ? planners::kept_apart{margins.following_s, margins.following_m}
               : planners::kept_apart{margins.crossing_s, 0};
  }

private:
  world::path_stretch all_of(std::size_t i) const {
    const auto& path = profiles_[i].line.way().path();
    return {&path, 0, path.length_m()};
  }

  world::road_map map_;
  std::vector<planners::route_profile> profiles_;
  std::vector<double> lines_m_;
  std::vector<std::pair<std::size_t, std::size_t>> arms_;
  std::array<std::array<world::meeting_curve, ways>, ways> meet_;
};

/// Six ways, on each of which so many cars set off from rest one after the
/// other, all known at once.
inline planners::order_problem any_traffic(const four_arms& crossing,
                                           std::size_t cars_each,
                                           double every_s, dice& dice) {
  struct coming {
    std::size_t way;
    double appears_s;
    planners::way_motion drive; // from when it appears on
  };
  std::vector<std::size_t> ways(four_arms::ways);
  for (std::size_t i = 0; i < ways.size(); ++i)
    ways[i] = i;
  for (std::size_t i = ways.size() - 1; i > 0; --i)
    std::swap(ways[i], ways[static_cast<std::size_t>(
                           dice.between(0, static_cast<double>(i + 1)))]);
  std::vector<coming> all;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& way = crossing.way(ways[i]);
    const auto from_m = dice.between(10, 40);
    const auto first_s = dice.between(0, 2);
    for (std::size_t k = 0; k < cars_each; ++k)
      all.push_back({ways[i], first_s + every_s * static_cast<double>(k),
                     planners::drive_freely(way, {}, from_m, 0,
                                            way.line.way().length_m())});
  }
  const auto line_s = [&](const coming& x) {
    return x.drive.time_s(crossing.line_m(x.way));
  };
  const auto wish_s = [&](const coming& x) { return x.appears_s + line_s(x); };
  std::ranges::stable_sort(all, {}, wish_s); // the order of each lane, too
  std::vector<planners::order_problem::car> cars;
  for (const auto& x : all)
    cars.push_back({crossing.arms(x.way).first - 1, wish_s(x), wish_s(x), {}});
  planners::order_problem problem{cars};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < all.size(); ++k)
      if (i != k)
        problem.set_lag(i, k,
                        planners::delay_s(crossing.meet(all[i].way, all[k].way),
                                          all[i].drive, all[k].drive,
                                          crossing.gap(all[i].way, all[k].way))
                            + line_s(all[k]) - line_s(all[i]));
  return problem;
}

} // namespace sofof::test
