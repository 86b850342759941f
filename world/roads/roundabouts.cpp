// From each lane the shortest ways back to it, as far as a ring may be long.
#include "world/roads/roundabouts.hpp"

#include "base/geometry.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace sofof::world {

namespace {

struct lane_graph {
  std::vector<double> length_m;
  std::vector<std::vector<std::size_t>> next;
};

lane_graph graph_of(const road_map& map) {
  std::unordered_map<std::string_view, std::size_t> places;
  for (std::size_t i = 0; i < map.lanes().size(); ++i)
    places.emplace(map.lanes()[i].name, i);
  lane_graph all;
  for (const auto& lane : map.lanes()) {
    auto& length_m = all.length_m.emplace_back(0);
    for (std::size_t k = 1; k < lane.centre.size(); ++k)
      length_m += distance_m(lane.centre[k - 1], lane.centre[k]);
    auto& next = all.next.emplace_back();
    for (const auto& name : lane.next)
      next.push_back(places.at(name));
  }
  assert(all.next.size() == all.length_m.size());
  return all;
}

/// A ring through a lane.
struct ring {
  double length_m = 0;
  std::vector<std::size_t> lanes;
};

/// @returns the shortest one (Dijkstra), unless it is too long.
std::optional<ring> ring_through(const lane_graph& all, std::size_t lane) {
  struct visit {
    double way_m = std::numeric_limits<double>::infinity(); // to its end
    std::size_t from = 0;
  };
  using place = std::pair<double, std::size_t>;
  std::priority_queue<place, std::vector<place>, std::greater<>> ends;
  std::unordered_map<std::size_t, visit> visits{{lane, {0, lane}}};
  ends.emplace(0, lane);
  while (!ends.empty()) {
    const auto [way_m, at] = ends.top();
    ends.pop();
    if (way_m + all.length_m[lane] > roundabouts::longest_m)
      return std::nullopt;
    for (const auto next : all.next[at]) {
      if (next == lane) {
        ring found{way_m + all.length_m[lane], {lane}};
        for (auto i = at; i != lane; i = visits[i].from)
          found.lanes.push_back(i);
        return found;
      }
      const auto there_m = way_m + all.length_m[next];
      if (auto& known = visits[next]; there_m < known.way_m) {
        known = {there_m, at};
        ends.emplace(there_m, next);
      }
    }
  }
  return std::nullopt;
}

} // namespace

roundabouts::roundabouts(const road_map& map) {
  const auto all = graph_of(map);
  constexpr auto none = std::numeric_limits<std::size_t>::max();
  of_.assign(all.next.size(), none);
  for (std::size_t lane = 0; lane < of_.size(); ++lane) {
    if (of_[lane] != none)
      continue;
    const auto found = ring_through(all, lane);
    if (!found)
      continue;
    for (const auto i : found->lanes)
      of_[i] = std::min(of_[i], places_.size());
    places_.push_back(std::max<std::size_t>(
        1, static_cast<std::size_t>(found->length_m / (2 * place_m))));
  }
  std::ranges::replace(of_, none, places_.size());
  assert(of_.size() == map.lanes().size());
}

} // namespace sofof::world
