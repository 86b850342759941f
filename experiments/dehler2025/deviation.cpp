// Two tracks, held side by side.
#include "experiments/dehler2025/deviation.hpp"

#include "base/text/csv_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace sofof::experiments::study {

namespace {

/// How a vehicle was at a place of its way.
struct passing {
  double s_m;
  double lateral_m;
  double speed_mps;
  bool remote;
};

using tracks = std::map<std::uint64_t, std::vector<passing>>; // by station

tracks read(const std::filesystem::path& folder) {
  constexpr std::string_view columns[] = {"station", "s_m", "lateral_m",
                                          "speed_mps", "source"};
  csv_reader rows{folder / "tracks.csv", columns};
  tracks all;
  while (rows.next())
    all[rows.whole(0)].push_back({rows.number(1), rows.number(2),
                                  rows.number(3), rows.text(4) == "remote"});
  return all;
}

/// @returns what lies between two lines at a place; nullopt beyond the ends.
std::optional<passing> at(const std::vector<passing>& track, double s_m) {
  const auto after = std::ranges::lower_bound(track, s_m, {}, &passing::s_m);
  if (after == track.begin() || after == track.end())
    return std::nullopt;
  const auto& a = *(after - 1);
  const auto& b = *after;
  const auto part = (s_m - a.s_m) / (b.s_m - a.s_m);
  return passing{s_m, std::lerp(a.lateral_m, b.lateral_m, part),
                 std::lerp(a.speed_mps, b.speed_mps, part), b.remote};
}

} // namespace

deviation deviation_between(const measured_run& offloaded,
                            const measured_run& local) {
  deviation d;
  const auto others = read(local.folder);
  for (const auto& [station, track] : read(offloaded.folder)) {
    const auto other = others.find(station);
    if (other == others.end())
      continue;
    for (const auto& here : track) {
      if (!here.remote)
        continue;
      const auto there = at(other->second, here.s_m);
      if (!there)
        continue;
      const auto path_m = std::abs(here.lateral_m - there->lateral_m);
      const auto speed_mps = std::abs(here.speed_mps - there->speed_mps);
      d.path_rms_m += path_m * path_m;
      d.speed_rms_mps += speed_mps * speed_mps;
      d.path_max_m = std::max(d.path_max_m, path_m);
      d.speed_max_mps = std::max(d.speed_max_mps, speed_mps);
      ++d.samples;
    }
  }
  if (d.samples > 0) {
    d.path_rms_m = std::sqrt(d.path_rms_m / d.samples);
    d.speed_rms_mps = std::sqrt(d.speed_rms_mps / d.samples);
  }
  return d;
}

} // namespace sofof::experiments::study
