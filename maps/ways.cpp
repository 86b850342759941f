// Ways through an imported network.
#include "maps/ways.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>
#include <string_view>
#include <unordered_map>

namespace sofof::maps {

namespace {

constexpr auto longest_way_m = 2500.0, shortest_way_m = 60.0;
constexpr auto nobody = std::numeric_limits<std::size_t>::max();

/// Walks through the network, least used lanes first.
class explorer {
public:
  explorer(const source_map& source, const std::vector<drawn_lane>& lanes)
      : source_{source.lanes}, lanes_{lanes}, next_{followers_of(lanes)},
        used_(lanes.size(), 0) {
    std::vector<bool> is_entered(lanes.size(), false);
    for (const auto& all : next_)
      for (const auto j : all)
        is_entered[j] = true;
    for (std::size_t i = 0; i < lanes.size(); ++i)
      if (!is_entered[i] && may_begin(i))
        entries_.push_back(i);
    if (entries_.empty())
      for (std::size_t i = 0; i < lanes.size(); ++i)
        if (may_begin(i))
          entries_.push_back(i);
  }

  std::vector<lane_route> explore(std::size_t most) {
    std::vector<lane_route> found;
    for (auto tries = 2 * most; tries > 0 && found.size() < most; --tries) {
      const auto begin = std::ranges::min_element(
          entries_, {}, [this](std::size_t i) { return used_[i]; });
      if (begin == entries_.end())
        break;
      auto way = walk(*begin);
      if (!way.lanes.empty()
          && std::ranges::none_of(
              found, [&way](const auto& x) { return x.lanes == way.lanes; })) {
        way.name = fmt::format("way {}", found.size() + 1);
        found.push_back(std::move(way));
      }
    }
    return found;
  }

private:
  bool may_begin(std::size_t i) const {
    return !source_[i].inside && lanes_[i].is_drivable();
  }

  /// @returns no lanes for a way that is too short.
  lane_route walk(std::size_t begin) {
    std::vector<std::size_t> way;
    auto length = 0.0;
    lane_route made;
    for (auto i = begin; i != nobody;) {
      way.push_back(i);
      ++used_[i];
      length += length_m(lanes_[i].is.centre);
      if (length > longest_way_m)
        break;
      auto best = nobody;
      for (const auto j : next_[i]) {
        if (j == begin)
          made.closed = true;
        if (lanes_[j].is_drivable() && std::ranges::find(way, j) == way.end()
            && (best == nobody || used_[j] < used_[best]))
          best = j;
      }
      i = made.closed ? nobody : best;
    }
    if (!made.closed)
      while (!way.empty() && source_[way.back()].inside)
        way.pop_back();
    if (length >= shortest_way_m)
      for (const auto i : way)
        made.lanes.push_back(lanes_[i].is.name);
    return made;
  }

  const std::vector<source_lane>& source_;
  const std::vector<drawn_lane>& lanes_;
  followers next_;
  std::vector<int> used_;
  std::vector<std::size_t> entries_;
};

} // namespace

followers followers_of(const std::vector<drawn_lane>& lanes) {
  std::unordered_map<std::string_view, std::size_t> index;
  for (std::size_t i = 0; i < lanes.size(); ++i)
    index.emplace(lanes[i].is.name, i);
  followers next(lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i)
    for (const auto& name : lanes[i].is.next)
      next[i].push_back(index.at(name));
  return next;
}

std::vector<lane_route> propose_ways(const source_map& source,
                                     const std::vector<drawn_lane>& lanes,
                                     std::size_t most) {
  assert(source.lanes.size() == lanes.size());
  return explorer{source, lanes}.explore(most);
}

way_finder::way_finder(const source_map& source,
                       const std::vector<drawn_lane>& lanes)
    : source_{source}, lanes_{lanes}, next_{followers_of(lanes)} {
  assert(source.lanes.size() == lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i)
    if (const auto& edges = source.lanes[i].edges; !edges.empty())
      by_edge_[edges.front()].push_back(i);
}

std::optional<std::vector<std::string>>
way_finder::lanes_for(const source_route& route) const {
  struct step {
    std::size_t lane, done; // edges of the route, this lane's included
    std::size_t from;       // in `steps`
  };
  std::vector<step> steps;
  std::map<std::pair<std::size_t, std::size_t>, bool> seen;
  const auto go = [&](std::size_t lane, std::size_t done, std::size_t from) {
    if (!lanes_[lane].is_drivable())
      return;
    for (const auto& edge : source_.lanes[lane].edges)
      if (done == route.edges.size() || route.edges[done++] != edge)
        return;
    if (seen.emplace(std::pair{lane, done}, true).second)
      steps.push_back({lane, done, from});
  };
  if (const auto first = route.edges.empty()
                             ? by_edge_.end()
                             : by_edge_.find(route.edges.front());
      first != by_edge_.end())
    for (const auto i : first->second)
      go(i, 0, nobody);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (steps[k].done == route.edges.size()) {
      std::vector<std::string> way;
      for (auto i = k; i != nobody; i = steps[i].from)
        way.insert(way.begin(), lanes_[steps[i].lane].is.name);
      return way;
    }
    for (const auto j : next_[steps[k].lane])
      go(j, steps[k].done, k);
  }
  return std::nullopt;
}

} // namespace sofof::maps
