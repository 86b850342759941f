// The streets: lanes, how they follow and cross each other, named routes.
#include "world/road_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace sofof {

namespace {

/// How far apart the ends of two lanes in a row may be, m.
constexpr auto joint_tolerance_m = 0.5;

/// Length of the straight pieces that `near_lanes` measures to, m.
constexpr auto piece_m = 1.0;

template <class... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) {
  throw std::invalid_argument{fmt::format(text, std::forward<Args>(args)...)};
}

void check(const lane& l) {
  if (l.centre.size() < 2)
    refuse("Lane '{}' needs at least two points.", l.name);
  if (l.half_width_m <= 0)
    refuse("Lane '{}' needs a width.", l.name);
  if (l.limits.empty() || l.limits.front().from_m != 0)
    refuse("Lane '{}' needs a speed limit from 0 m on.", l.name);
  for (std::size_t i = 0; i < l.limits.size(); ++i) {
    if (l.limits[i].limit_mps <= 0)
      refuse("Lane '{}' has a speed limit that is not positive.", l.name);
    if (i > 0 && l.limits[i].from_m <= l.limits[i - 1].from_m)
      refuse("The speed zones of lane '{}' are out of order.", l.name);
  }
}

path smooth(const lane& l) {
  try {
    return path{l.centre};
  } catch (const std::invalid_argument& problem) {
    refuse("Lane '{}': {}", l.name, problem.what());
  }
}

} // namespace

road_map::road_map(std::string name, geo_origin origin, std::vector<lane> lanes,
                   std::vector<building> buildings)
    : name_{std::move(name)}, origin_{origin}, lanes_{std::move(lanes)},
      buildings_{std::move(buildings)} {
  std::vector<path> paths;
  paths.reserve(lanes_.size());
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    check(lanes_[i]);
    if (!index_.emplace(lanes_[i].name, i).second)
      refuse("There are two lanes '{}'.", lanes_[i].name);
    paths.push_back(smooth(lanes_[i]));
    cut(paths.back());
  }
  for (const auto& l : lanes_)
    resolve(l);
  conflicts_ = find_conflicts(paths, next_);
}

void road_map::resolve(const lane& l) {
  auto& followers = next_.emplace_back();
  for (const auto& name : l.next) {
    const auto found = index_.find(name);
    if (found == index_.end())
      refuse("Lane '{}' leads to '{}', which is not on the map.", l.name, name);
    const auto gap_m =
        distance_m(l.centre.back(), lanes_[found->second].centre.front());
    if (gap_m > joint_tolerance_m)
      refuse("Lane '{}' ends {:.1f} m from where '{}' begins.", l.name, gap_m,
             name);
    followers.push_back(found->second);
  }
}

void road_map::cut(const path& line) {
  const auto count = std::ceil(line.length_m() / piece_m);
  auto last = line.at(0).at;
  for (auto i = 1.0; i <= count; ++i) {
    const auto here = line.at(line.length_m() * i / count).at;
    cells_.add(last, here, 0, static_cast<cell_grid::item>(pieces_.size()));
    pieces_.emplace_back(last, here);
    last = here;
  }
  ends_.push_back(pieces_.size());
}

route_ptr road_map::make_route(std::string name,
                               std::span<const std::string> lanes,
                               bool closed) const {
  if (lanes.empty())
    refuse("Route '{}' has no lanes.", name);
  std::vector<std::size_t> sequence;
  for (const auto& l : lanes) {
    const auto found = index_.find(l);
    if (found == index_.end())
      refuse("Route '{}': lane '{}' is not on the map.", name, l);
    sequence.push_back(found->second);
  }
  const auto joints = closed ? sequence.size() : sequence.size() - 1;
  for (std::size_t i = 0; i < joints; ++i) {
    const auto from = sequence[i], to = sequence[(i + 1) % sequence.size()];
    if (std::ranges::find(next_[from], to) == next_[from].end())
      refuse("Route '{}': lane '{}' does not follow '{}'.", name,
             lanes_[to].name, lanes_[from].name);
  }
  return std::make_shared<route>(std::move(name), lanes_, std::move(sequence),
                                 closed);
}

std::size_t road_map::lane_of(std::size_t piece) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(ends_, piece)
                                  - ends_.begin());
}

// The next point is sought as far along the lane of the last one, then on the
// lanes that follow it, then everywhere.
bool road_map::near_lanes(std::span<const point> points,
                          double tolerance_m) const {
  std::size_t lane = 0, piece = 0; // near the last point
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto is_near = [&](std::size_t other) {
      const auto& [a, b] = pieces_[other];
      const auto off = points[i] - a; // mostly that is enough
      return dot(off, off) <= tolerance_m * tolerance_m
             || distance_to_segment_m(points[i], a, b) <= tolerance_m;
    };
    if (i > 0) {
      const auto moved = distance_m(points[i - 1], points[i]) / piece_m + 0.5;
      const auto ahead = piece + static_cast<std::size_t>(std::min(1e6, moved));
      if (ahead < ends_[lane] && is_near(ahead)) {
        piece = ahead;
        continue;
      }
      const auto& next = next_[lane];
      const auto beyond = ahead - std::min(ahead, ends_[lane]);
      const auto follower = std::ranges::find_if(next, [&](std::size_t other) {
        const auto begin = other > 0 ? ends_[other - 1] : 0;
        return begin + beyond < ends_[other] && is_near(begin + beyond);
      });
      if (follower != next.end()) {
        lane = *follower;
        piece = (lane > 0 ? ends_[lane - 1] : 0) + beyond;
        continue;
      }
    }
    const auto found = cells_.any_near(points[i], tolerance_m, is_near);
    if (!found)
      return false;
    piece = *found;
    lane = lane_of(piece);
  }
  return true;
}

} // namespace sofof
