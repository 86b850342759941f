// Makes a network that can be driven of what a source says.
#include "maps/lane_network.hpp"

#include "maps/road_limits.hpp"
#include <algorithm>
#include <numeric>
#include <string_view>
#include <unordered_map>

namespace sofof::maps {

namespace {

constexpr auto short_m = 1.0, least_m = 0.01;
constexpr auto least_part_m = 50.0;

class network {
public:
  explicit network(source_map& map)
      : map_{map}, lanes_{map.lanes}, next_(lanes_.size()),
        previous_(lanes_.size()), gone_(lanes_.size(), false) {
    std::unordered_map<std::string_view, std::size_t> index;
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      index.emplace(lanes_[i].name, i);
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      for (const auto& name : lanes_[i].next)
        if (const auto found = index.find(name);
            found != index.end() && found->second != i)
          link(i, found->second);
  }

  /// Removes ends inside junctions, again and again.
  void drop_dead_ends() {
    std::vector<std::size_t> open(lanes_.size());
    std::iota(open.begin(), open.end(), 0);
    while (!open.empty()) {
      const auto i = open.back();
      open.pop_back();
      if (gone_[i] || !lanes_[i].inside
          || (!next_[i].empty() && !previous_[i].empty()))
        continue;
      for (const auto* around : {&next_[i], &previous_[i]})
        open.insert(open.end(), around->begin(), around->end());
      drop(i);
    }
  }

  void join_halves() {
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      while (!gone_[i] && next_[i].size() == 1) {
        const auto j = next_[i].front();
        if (j == i || !lanes_[i].inside || !lanes_[j].inside
            || previous_[j].size() != 1
            || lanes_[i].centre.size() + lanes_[j].centre.size() > most_points)
          break;
        lanes_[i].rank = std::max(lanes_[i].rank, lanes_[j].rank);
        append(i, j);
      }
  }

  void join_short_ones() {
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      if (!gone_[i] && length_m(lanes_[i].centre) < short_m && join(i))
        ++map_.left_out["lanes shorter than 1 m, joined to others"];
  }

  /// They have no direction.
  void drop_mere_points() {
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      if (!gone_[i] && length_m(lanes_[i].centre) < least_m) {
        drop(i);
        ++map_.left_out["lanes shorter than 1 cm"];
      }
  }

  void drop_isolated_parts() {
    std::vector<bool> seen(lanes_.size(), false);
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      std::vector<std::size_t> part{i};
      if (gone_[i] || seen[i])
        continue;
      seen[i] = true;
      auto all_m = 0.0;
      for (std::size_t k = 0; k < part.size(); ++k) {
        all_m += length_m(lanes_[part[k]].centre);
        for (const auto* around : {&next_[part[k]], &previous_[part[k]]})
          for (const auto j : *around)
            if (!seen[j]) {
              seen[j] = true;
              part.push_back(j);
            }
      }
      if (all_m >= least_part_m)
        continue;
      map_.left_out["lanes of isolated parts"] += part.size();
      for (const auto k : part)
        gone_[k] = true;
    }
  }

  void write_back() {
    std::vector<source_lane> kept;
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      if (gone_[i])
        continue;
      auto& l = kept.emplace_back(lanes_[i]);
      l.next.clear();
      for (const auto j : next_[i])
        l.next.push_back(lanes_[j].name);
    }
    lanes_ = std::move(kept);
  }

private:
  void link(std::size_t from, std::size_t to) {
    if (std::ranges::find(next_[from], to) != next_[from].end())
      return;
    next_[from].push_back(to);
    previous_[to].push_back(from);
  }

  void drop(std::size_t i) {
    for (const auto j : next_[i])
      std::erase(previous_[j], i);
    for (const auto j : previous_[i])
      std::erase(next_[j], i);
    next_[i].clear();
    previous_[i].clear();
    gone_[i] = true;
  }

  /// Puts lane j behind lane i, without its name.
  void extend(std::size_t i, const source_lane& j) {
    auto& l = lanes_[i];
    l.centre.insert(l.centre.end(), j.centre.begin(), j.centre.end());
    l.edges.insert(l.edges.end(), j.edges.begin(), j.edges.end());
  }

  void append(std::size_t i, std::size_t j) {
    extend(i, lanes_[j]);
    const auto after = next_[j];
    drop(j);
    for (const auto k : after)
      link(i, k);
  }

  void prepend(std::size_t i, std::size_t j) {
    auto& l = lanes_[j];
    l.centre.insert(l.centre.begin(), lanes_[i].centre.begin(),
                    lanes_[i].centre.end());
    l.edges.insert(l.edges.begin(), lanes_[i].edges.begin(),
                   lanes_[i].edges.end());
  }

  /// @returns whether lane i could become a part of its neighbours.
  bool join(std::size_t i) {
    const auto before = previous_[i], after = next_[i];
    const auto is_only = [i](const auto& around, const auto& links) {
      return !around.empty() && std::ranges::all_of(around, [&](std::size_t k) {
        return k != i && links[k].size() == 1;
      });
    };
    const auto has_room = [](const auto& around, const auto& links,
                             std::size_t more) {
      return std::ranges::all_of(around, [&](std::size_t k) {
        return links[k].size() + more <= most_links + 1;
      });
    };
    if (!has_room(before, next_, after.size())
        || !has_room(after, previous_, before.size()))
      return false;
    if (is_only(before, next_)) {
      for (const auto k : before)
        extend(k, lanes_[i]);
    } else if (is_only(after, previous_)) {
      for (const auto k : after)
        prepend(i, k);
    } else {
      return false;
    }
    drop(i);
    for (const auto k : before)
      for (const auto j : after)
        link(k, j);
    return true;
  }

  source_map& map_;
  std::vector<source_lane>& lanes_;
  std::vector<std::vector<std::size_t>> next_, previous_;
  std::vector<bool> gone_;
};

} // namespace

void tidy(source_map& map) {
  network all{map};
  all.drop_dead_ends();
  all.join_halves();
  all.join_short_ones();
  all.drop_mere_points();
  all.drop_dead_ends();
  all.drop_isolated_parts();
  all.write_back();
}

} // namespace sofof::maps
