// Where lanes meet: the stretches that two cars must not drive at once.
#include "world/roads/conflict.hpp"

#include "base/cell_grid.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace sofof::world {

namespace {

constexpr auto sample_m = 0.5;

using lane_pair = std::pair<std::size_t, std::size_t>;

struct stretch {
  double from_m, to_m;
};

/// A path as points, equidistant and close to each other.
struct dotted_line {
  std::vector<point> points;
  double step_m;

  explicit dotted_line(const path& line) {
    const auto count = std::ceil(line.length_m() / sample_m);
    step_m = line.length_m() / count;
    for (auto i = 0.0; i <= count; ++i)
      points.push_back(line.at(i * step_m).at);
  }
};

using dotted_lines = std::span<const dotted_line>;

/// @returns the pairs of lanes, lower index first, that share a cell.
std::vector<lane_pair> neighbours(dotted_lines lines) {
  constexpr std::size_t stride = 8;
  cell_grid grid;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& dots = lines[i].points;
    for (std::size_t k = 0; k + 1 < dots.size(); k += stride)
      grid.add(dots[k], dots[std::min(k + stride, dots.size() - 1)],
               meeting_distance_m, static_cast<cell_grid::item>(i));
  }
  std::vector<lane_pair> pairs;
  grid.for_each_cell([&](std::span<const cell_grid::item> lanes) {
    for (const auto a : lanes)
      for (const auto b : lanes)
        if (a < b)
          pairs.emplace_back(a, b);
  });
  std::ranges::sort(pairs);
  const auto doubles = std::ranges::unique(pairs);
  pairs.erase(doubles.begin(), doubles.end());
  return pairs;
}

/// Walks along a line from end to end. `look(i)` returns how far ahead of
/// point i there is nothing of interest, m.
template <class Function>
void march(const dotted_line& line, Function look) {
  const auto last = line.points.size() - 1;
  for (std::size_t i = 0;;) {
    const auto skip = std::max(1.0, look(i) / line.step_m);
    if (i == last)
      return;
    i = std::min(i + static_cast<std::size_t>(skip), last);
  }
}

/// What of a line is near a point.
struct vicinity {
  std::optional<stretch> near;
  double gap_m; ///< If nothing is: how far the point may move, at least,
                ///< until something is.
};

// Distances change by at most a metre a metre. So a point with a gap of g to
// the meeting distance allows to skip g; and between two points a step apart,
// with gaps g and h, the gap is at least (g + h - step) / 2.

vicinity look_around(const dotted_line& line, point p) {
  vicinity seen{{}, 1e9};
  auto last_s_m = 0.0, last_gap_m = 1e9;
  march(line, [&](std::size_t i) {
    const auto s_m = line.step_m * static_cast<double>(i);
    const auto gap_m = distance_m(line.points[i], p) - meeting_distance_m;
    if (gap_m <= 0)
      seen.near = {seen.near ? seen.near->from_m : s_m, s_m};
    const auto between_m = (last_gap_m + gap_m - (s_m - last_s_m)) / 2;
    seen.gap_m = std::min({seen.gap_m, gap_m, between_m});
    last_s_m = s_m, last_gap_m = gap_m;
    return gap_m;
  });
  return seen;
}

/// A stretch of one line that is near a stretch of another.
struct meeting {
  stretch on_a, on_b;
};

std::vector<meeting> find_meetings(const dotted_line& a, const dotted_line& b) {
  std::vector<meeting> found;
  march(a, [&](std::size_t i) {
    const auto s_m = a.step_m * static_cast<double>(i);
    const auto seen = look_around(b, a.points[i]);
    if (!seen.near)
      return seen.gap_m;
    if (found.empty() || s_m - found.back().on_a.to_m > 2 * meeting_margin_m) {
      found.push_back({{s_m, s_m}, *seen.near});
    } else {
      auto& [on_a, on_b] = found.back();
      on_a.to_m = s_m;
      on_b.from_m = std::min(on_b.from_m, seen.near->from_m);
      on_b.to_m = std::max(on_b.to_m, seen.near->to_m);
    }
    return 0.0;
  });
  return found;
}

stretch grow(stretch x, double length_m) {
  return {std::max(x.from_m - meeting_margin_m, 0.0),
          std::min(x.to_m + meeting_margin_m, length_m)};
}

bool share_one(std::span<const std::size_t> a, std::span<const std::size_t> b) {
  return std::ranges::find_first_of(a, b) != a.end();
}

} // namespace

std::vector<conflict>
find_conflicts(std::span<const path> paths,
               std::span<const std::vector<std::size_t>> next) {
  std::vector<std::vector<std::size_t>> previous(next.size());
  for (std::size_t i = 0; i < next.size(); ++i)
    for (const auto follower : next[i])
      previous[follower].push_back(i);
  const std::vector<dotted_line> lines(paths.begin(), paths.end());
  std::vector<conflict> conflicts;
  for (const auto& [a, b] : neighbours(lines)) {
    if (std::ranges::count(next[a], b) + std::ranges::count(next[b], a) > 0)
      continue;
    for (const auto& found : find_meetings(lines[a], lines[b])) {
      const auto on_a = grow(found.on_a, paths[a].length_m());
      const auto on_b = grow(found.on_b, paths[b].length_m());
      auto how = conflict::kind::crossing;
      if (on_a.from_m == 0 && on_b.from_m == 0
          && share_one(previous[a], previous[b]))
        how = conflict::kind::diverge;
      else if (on_a.to_m == paths[a].length_m()
               && on_b.to_m == paths[b].length_m()
               && share_one(next[a], next[b]))
        how = conflict::kind::merge;
      conflicts.push_back(
          {a, b, on_a.from_m, on_a.to_m, on_b.from_m, on_b.to_m, how});
    }
  }
  return conflicts;
}

} // namespace sofof::world
