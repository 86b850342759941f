// Over which lanes a planning problem is driven.
#include "experiments/judge/problem_way.hpp"

#include "world/roads/path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sofof::experiments::judge {

namespace {

/// Who is farther beside a lane than its half width and this is not on it, m;
/// nor who is farther before its begin or behind its end.
constexpr auto beside_lane_m = 0.5, before_lane_m = 6.0;
/// Nor who is turned from it by more than 60°.
constexpr auto start_cosine = 0.5;

/// The way begins so far behind the vehicle, and ends so far behind the goal.
constexpr auto behind_m = 10.0, beyond_m = 200.0;
constexpr auto point_every_m = 10.0;

constexpr auto none = std::numeric_limits<std::size_t>::max();

using lanes_of_way = std::vector<std::size_t>;

class way_search {
public:
  way_search(maps::imported_map map, const maps::planning_problem& problem)
      : map_{std::move(map)}, problem_{problem} {
    for (std::size_t i = 0; i < map_.lanes.size(); ++i) {
      index_.emplace(map_.lanes[i].name, i);
      paths_.emplace_back(map_.lanes[i].centre);
    }
    before_.resize(map_.lanes.size());
    next_.resize(map_.lanes.size());
    for (std::size_t i = 0; i < map_.lanes.size(); ++i)
      for (const auto& name : map_.lanes[i].next)
        if (const auto j = index_.at(name); is_drivable(i) && is_drivable(j)) {
          next_[i].push_back(j);
          before_[j].push_back(i);
        }
  }

  std::variant<maps::imported_map, no_way> find() {
    const auto starts = find_starts();
    if (starts.empty())
      return no_way{"the start is on no lane that a car can drive."};
    const auto goals = find_goals();
    const auto is_anywhere = std::ranges::any_of(
        problem_.goals, [](const auto& goal) { return goal.places.empty(); });
    if (goals.empty() && !is_anywhere)
      return no_way{"no lane leads through a goal's place."};
    for (const auto& [off_m, lane, s_m] : starts)
      if (auto way =
              is_anywhere ? lanes_of_way{lane} : shortest(lane, s_m, goals);
          !way.empty()) {
        complete(std::move(way), s_m);
        return std::move(map_);
      }
    return no_way{"no lanes lead from the start to a goal's place without a "
                  "lane change."};
  }

private:
  struct start {
    double off_m; // how badly it fits
    std::size_t lane;
    double s_m;

    auto operator<=>(const start&) const = default;
  };

  bool is_drivable(std::size_t lane) const {
    return std::ranges::find(map_.too_sharp, map_.lanes[lane].name)
           == map_.too_sharp.end();
  }

  std::vector<start> find_starts() const {
    std::vector<start> found;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (!is_drivable(i))
        continue;
      const auto at = paths_[i].project(problem_.at);
      const auto turn_rad =
          problem_.heading_rad - paths_[i].at(at.s_m).heading_rad;
      if (std::abs(at.d_m) <= map_.lanes[i].half_width_m + beside_lane_m
          && std::abs(at.beyond_m) <= before_lane_m
          && std::cos(turn_rad) >= start_cosine)
        found.push_back(
            {std::hypot(at.d_m, at.beyond_m) + 5 * std::abs(std::sin(turn_rad)),
             i, at.s_m});
    }
    std::ranges::sort(found);
    return found;
  }

  /// @returns lanes that lead through a place, and where they leave it last.
  std::unordered_map<std::size_t, double> find_goals() const {
    constexpr auto step_m = 0.25;
    std::unordered_map<std::size_t, double> found;
    for (std::size_t i = 0; i < paths_.size(); ++i)
      for (auto s_m = 0.0; is_drivable(i) && s_m <= paths_[i].length_m();
           s_m += step_m)
        if (is_in_place(paths_[i].at(s_m).at))
          found[i] = s_m;
    return found;
  }

  bool is_in_place(point p) const {
    for (const auto& goal : problem_.goals)
      for (const auto& place : goal.places)
        if (place.contains(p))
          return true;
    return false;
  }

  lanes_of_way shortest(std::size_t from, double from_m,
                        const std::unordered_map<std::size_t, double>& goals) {
    if (const auto here = goals.find(from);
        here != goals.end() && here->second > from_m)
      return {from};
    std::vector<double> way_m(paths_.size(),
                              std::numeric_limits<double>::infinity());
    std::vector<std::size_t> came(paths_.size(), none);
    using entry = std::pair<double, std::size_t>;
    std::priority_queue<entry, std::vector<entry>, std::greater<>> open;
    const auto leave = [&](double so_far_m, std::size_t lane) {
      for (const auto j : next_[lane])
        if (so_far_m < way_m[j]) {
          way_m[j] = so_far_m;
          came[j] = lane;
          open.emplace(so_far_m, j);
        }
    };
    leave(paths_[from].length_m() - from_m, from);
    while (!open.empty()) {
      const auto [so_far_m, lane] = open.top();
      open.pop();
      if (so_far_m > way_m[lane] || lane == from)
        continue;
      if (goals.contains(lane)) {
        lanes_of_way way{lane};
        for (auto i = came[lane]; i != from; i = came[i])
          way.push_back(i);
        way.push_back(from);
        std::ranges::reverse(way);
        return way;
      }
      leave(so_far_m + paths_[lane].length_m(), lane);
    }
    return {};
  }

  /// @returns of the lanes that may follow or precede one the straightest.
  std::size_t straightest(const std::vector<std::size_t>& all, double from_rad,
                          const lanes_of_way& way, bool at_end) const {
    auto best = none;
    auto best_cosine = 0.0;
    for (const auto i : all) {
      const auto far_rad =
          paths_[i].at(at_end ? paths_[i].length_m() : 0).heading_rad;
      const auto cosine = std::cos(far_rad - from_rad) + 2;
      if (std::ranges::find(way, i) == way.end() && cosine > best_cosine) {
        best = i;
        best_cosine = cosine;
      }
    }
    return best;
  }

  void complete(lanes_of_way way, double start_m) {
    auto room_m = start_m;
    while (room_m < behind_m) {
      const auto first = way.front();
      const auto i = straightest(before_[first],
                                 paths_[first].at(0).heading_rad, way, false);
      if (i == none)
        break;
      way.insert(way.begin(), i);
      room_m += paths_[i].length_m();
    }
    if (room_m < behind_m)
      draw_out_begin(way.front());
    auto rest_m = 0.0;
    while (rest_m < beyond_m) {
      const auto last = way.back();
      const auto& path = paths_[last];
      const auto i = straightest(
          next_[last], path.at(path.length_m()).heading_rad, way, true);
      if (i == none)
        break;
      way.push_back(i);
      rest_m += paths_[i].length_m();
    }
    if (rest_m < beyond_m)
      draw_out_end(way.back(), beyond_m - rest_m);
    maps::lane_route route{.name = way_name, .lanes = {}};
    for (const auto i : way)
      route.lanes.push_back(map_.lanes[i].name);
    map_.routes = {std::move(route)};
  }

  static point direction(double heading_rad) {
    return {std::cos(heading_rad), std::sin(heading_rad)};
  }

  void draw_out_begin(std::size_t i) {
    auto& lane = map_.lanes[i];
    const auto back = direction(paths_[i].at(0).heading_rad);
    const auto begin = lane.centre.front();
    for (auto s_m = point_every_m / 2; s_m <= 2 * behind_m;
         s_m += point_every_m / 2)
      lane.centre.insert(lane.centre.begin(), begin - s_m * back);
    for (auto& other : map_.lanes)
      std::erase(other.next, lane.name);
  }

  void draw_out_end(std::size_t i, double by_m) {
    auto& lane = map_.lanes[i];
    const auto ahead =
        direction(paths_[i].at(paths_[i].length_m()).heading_rad);
    const auto end = lane.centre.back();
    for (auto s_m = point_every_m; s_m < by_m + point_every_m;
         s_m += point_every_m)
      lane.centre.push_back(end + s_m * ahead);
    lane.next.clear();
  }

  maps::imported_map map_;
  const maps::planning_problem& problem_;
  std::unordered_map<std::string, std::size_t> index_;
  std::vector<world::path> paths_;
  std::vector<std::vector<std::size_t>> before_, next_; // drivable ones
};

} // namespace

std::variant<maps::imported_map, no_way>
choose_way(maps::imported_map map, const maps::planning_problem& problem) {
  return way_search{std::move(map), problem}.find();
}

} // namespace sofof::experiments::judge
