// The streets: lanes, how they follow and cross each other, named routes.
#include "world/roads/road_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace sofof::world {

namespace {

/// How far apart the ends of two lanes in a row may be, m.
constexpr auto joint_tolerance_m = 0.5;

/// A lane and its opposite are driven against each other to within 25°, their
/// edges at most so far apart, m.
constexpr auto against_cosine = -0.906;
constexpr auto beside_tolerance_m = 0.75;

/// The straight pieces that `near_lanes` measures to end on the centre line, at
/// multiples of this, m, are at most so many of them long, and so near to what
/// is between, m.
constexpr auto step_m = 1.0;
constexpr std::size_t longest_piece = 64;
constexpr auto piece_error_m = 0.05;

/// So many pieces ahead of the last one the next point is looked for.
constexpr std::size_t pieces_ahead = 8;

constexpr auto no_piece = std::numeric_limits<std::uint32_t>::max();

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
  std::vector<std::size_t> first_pieces;
  paths.reserve(lanes_.size());
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    check(lanes_[i]);
    if (!index_.emplace(lanes_[i].name, i).second)
      refuse("There are two lanes '{}'.", lanes_[i].name);
    paths.push_back(smooth(lanes_[i]));
    first_pieces.push_back(pieces_.size());
    cut(paths.back());
  }
  for (const auto& l : lanes_)
    resolve(l);
  for (const auto& l : lanes_)
    check_opposite(l, paths);
  join(first_pieces);
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

/// Somebody who leaves a lane to the left has to come to the other one.
void road_map::check_opposite(const lane& l,
                              std::span<const path> paths) const {
  if (l.opposite.empty())
    return;
  const auto found = index_.find(l.opposite);
  if (found == index_.end())
    refuse("Lane '{}' lies opposite '{}', which is not on the map.", l.name,
           l.opposite);
  const auto& own = paths[index_.at(l.name)];
  const auto& other = paths[found->second];
  const auto apart_m = l.half_width_m + lanes_[found->second].half_width_m;
  for (const auto share : {0.1, 0.5, 0.9}) {
    const auto here = own.at(share * own.length_m());
    const auto on = other.project(here.at);
    const auto turned_rad = here.heading_rad - other.at(on.s_m).heading_rad;
    if (std::cos(turned_rad) > against_cosine
        || std::abs(on.d_m - apart_m) > beside_tolerance_m)
      refuse("Lane '{}' does not lie beside '{}', on the left and driven the "
             "other way, at {:.0f} m.",
             l.opposite, l.name, share * own.length_m());
  }
}

void road_map::cut(const path& line) {
  const auto count =
      static_cast<std::size_t>(std::ceil(line.length_m() / step_m));
  std::vector<point> all;
  for (std::size_t i = 0; i <= count; ++i)
    all.push_back(line.at(line.length_m() * static_cast<double>(i)
                          / static_cast<double>(count))
                      .at);
  const auto is_straight = [&](std::size_t from, std::size_t to) {
    return std::all_of(&all[from], &all[to], [&](point p) {
      return distance_to_segment_m(p, all[from], all[to]) <= piece_error_m;
    });
  };
  for (std::size_t from = 0; from < count;) {
    auto to = from + 1;
    while (to < count && to - from < longest_piece && is_straight(from, to + 1))
      ++to;
    cells_.add(all[from], all[to], 0,
               static_cast<cell_grid::item>(pieces_.size()));
    const auto length_m = distance_m(all[from], all[to]);
    pieces_.push_back(
        {all[from], 1 / length_m * (all[to] - all[from]), length_m, 0});
    from = to;
  }
}

void road_map::join(std::span<const std::size_t> first_pieces) {
  followers_ = {no_piece}; // of what is not the last piece of its lane
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    const auto end =
        i + 1 < lanes_.size() ? first_pieces[i + 1] : pieces_.size();
    pieces_[end - 1].followers = static_cast<std::uint32_t>(followers_.size());
    for (const auto next : next_[i])
      followers_.push_back(static_cast<std::uint32_t>(first_pieces[next]));
    followers_.push_back(no_piece);
  }
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
                                 closed, index_);
}

// On the lane of `x`, from it on, then on the lanes that follow.
template <class Predicate>
const road_map::piece* road_map::find_ahead(const piece* x,
                                            Predicate is_near) const {
  const piece* found = nullptr;
  const auto find_on_lane = [&](const piece* from) {
    const piece* last = nullptr;
    for (auto n = pieces_ahead; n > 0 && !found && !last; --n, ++from) {
      if (is_near(*from))
        found = from;
      else if (from->followers)
        last = from;
    }
    return last;
  };
  if (const auto* last = find_on_lane(x))
    for (auto i = last->followers; !found && followers_[i] != no_piece; ++i)
      find_on_lane(&pieces_[followers_[i]]);
  return found;
}

// The next point is sought near the piece of the last one and those after it,
// then everywhere.
bool road_map::near_lanes(std::span<const point> points,
                          double tolerance_m) const {
  const piece* found = nullptr;
  for (const auto& p : points) {
    const auto is_near = [&](const piece& x) {
      const auto along_m =
          std::clamp(dot(p - x.from, x.along), 0.0, x.length_m);
      const auto off = p - x.from - along_m * x.along;
      return dot(off, off) <= tolerance_m * tolerance_m;
    };
    if (found)
      found = find_ahead(found, is_near);
    if (!found) {
      const auto anywhere = cells_.any_near(
          p, tolerance_m, [&](auto i) { return is_near(pieces_[i]); });
      if (!anywhere)
        return false;
      found = &pieces_[*anywhere];
    }
  }
  return true;
}

} // namespace sofof::world
