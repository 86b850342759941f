// From claims.csv.
#include "experiments/report/crossing_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::experiments::report {

namespace {

constexpr auto bar_gap = std::numeric_limits<double>::quiet_NaN();
/// Lanes are 1 apart.
constexpr auto higher = 0.15, given_up_higher = 0.5;

/// Of one lane, in order of time.
using claims_of_lane = std::vector<claim_line>;

std::map<std::string, claims_of_lane> by_lane(std::vector<claim_line> all) {
  std::ranges::sort(all, {}, [](const claim_line& x) {
    return std::pair{x.enters_s, x.station};
  });
  std::map<std::string, claims_of_lane> lanes;
  for (auto& x : all)
    lanes[x.lane].push_back(std::move(x));
  return lanes;
}

/// Level lines, from when vehicles enter to when they leave.
struct bars {
  curve shown;
  double until_s = -std::numeric_limits<double>::infinity();

  void add(const claim_line& x, double level) {
    for (const auto& [t_s, y] :
         {std::pair{x.enters_s, level}, std::pair{x.leaves_s, level},
          std::pair{x.leaves_s, bar_gap}}) {
      shown.x.push_back(t_s);
      shown.y.push_back(y);
      shown.stations.push_back(static_cast<double>(x.station));
    }
    until_s = x.leaves_s;
  }
};

/// One lane's; who follows while the one ahead is still there, a little higher.
void add_lane(figure& to, const std::string& lane, const claims_of_lane& claims,
              double level, bool kept) {
  std::vector<bars> rows;
  for (const auto& x : claims) {
    if (x.was_kept != kept || x.leaves_s <= x.enters_s)
      continue;
    auto row = std::ranges::find_if(
        rows, [&](const bars& r) { return r.until_s < x.enters_s; });
    if (row == rows.end()) {
      row = rows.insert(row, bars{});
      row->shown.name = rows.size() == 1 ? lane : lane + ", behind it";
      if (!kept)
        row->shown.name += ", given up";
      row->shown.dashed = !kept;
    }
    row->add(x, level + higher * static_cast<double>(row - rows.begin())
                    + (kept ? 0 : given_up_higher));
  }
  for (auto& row : rows)
    to.curves.push_back(std::move(row.shown));
}

figure windows_of(const std::map<std::string, claims_of_lane>& lanes,
                  const std::string& title) {
  figure all;
  all.title = title;
  all.x_label = "time, s";
  all.y_label = "lane by which they come";
  all.by_clock = true;
  all.caption = "A bar is the time from when a vehicle enters the crossing to "
                "when it has left, as it claimed it. Dashed ones were given up "
                "before.";
  auto level = 0.0;
  for (const auto& [lane, claims] : lanes) {
    ++level;
    all.levels.emplace_back(level, lane);
    add_lane(all, lane, claims, level, true);
    add_lane(all, lane, claims, level, false);
  }
  return all;
}

paragraph count_of(const std::vector<claim_line>& all) {
  std::size_t kept = 0, bound = 0;
  auto longest_s = 0.0;
  for (const auto& x : all) {
    kept += x.was_kept;
    bound += x.bound_s.has_value();
    if (x.bound_s)
      longest_s = std::max(longest_s, *x.bound_s - x.claimed_s);
  }
  return {fmt::format("{} claims: {} were bound, after {:.2f} s at most, {} "
                      "were kept.",
                      all.size(), bound, longest_s, kept)};
}

} // namespace

section crossing_section(std::span<const recorded_run> runs) {
  section all{.title = "Crossings", .blocks = {}};
  for (const auto& run : runs) {
    const auto claims = read_claims(run.folder);
    if (claims.empty())
      continue;
    all.blocks.emplace_back(
        windows_of(by_lane(claims),
                   runs.size() == 1 ? "Windows of the crossing"
                                    : "Windows of the crossing, " + run.label));
    all.blocks.emplace_back(count_of(claims));
  }
  return all;
}

} // namespace sofof::experiments::report
