// Runs that are made up, for sections of the paper's evaluation.
#pragma once

#include "experiments/dehler2025/sections.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

namespace sofof::experiments::study::made_up {

using test::scratch;

inline void write(const std::filesystem::path& file, std::string_view text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream{file} << text;
}

template <class Block>
const Block& the(const report::section& s, std::string_view title) {
  for (const auto& block : s.blocks)
    if (const auto* found = std::get_if<Block>(&block))
      if (found->title.starts_with(title))
        return *found;
  FAIL("there is no such block: ", title);
  throw 0;
}

inline constexpr std::string_view tracks_header =
    "t_s,station,x_m,y_m,s_m,lateral_m,heading_rad,speed_mps,source\n";

/// A folder whose vehicle drives east at 10 m/s, a line a second.
inline measured_run driven(const std::filesystem::path& folder,
                           double lateral_m, double speed_mps,
                           std::string_view source) {
  std::string tracks{tracks_header};
  for (int t = 0; t <= 100; ++t)
    tracks += fmt::format("{0},101,{1},0,{2},{3},0,{4},{5}\n", t, -500 + 10 * t,
                          10 * t, lateral_m, speed_mps, source);
  write(folder / "tracks.csv", tracks);
  write(folder / "config.toml", R"([street_grid]
[[fleet]]
routes = ["block *"]
[[provider]]
area_m = [[-200.0, -100.0], [300.0, -100.0], [300.0, 100.0], [-200.0, 100.0]]
[[service]]
name = "trajectory_planning"
)");
  return {{{"1"}, 1, {}}, folder, {}, {}, 0};
}

inline constexpr std::string_view episodes_header =
    "side,station,provider,provider_id,service,counter,accepted_s,"
    "first_data_s,ended_s,t_off_s,reason,fallback\n";

/// @returns all paragraphs of a section.
inline std::string words_of(const report::section& s) {
  std::string all;
  for (const auto& block : s.blocks)
    if (const auto* found = std::get_if<report::paragraph>(&block))
      all += found->text + '\n';
  return all;
}

/// Two curves over two limits with these heights, in an area that takes 51 s,
/// and three early ends of six vehicles.
inline paper_runs two_curves(const scratch& dir, double one_s, double six_s,
                             std::uint64_t ended_late) {
  paper_runs e;
  for (const auto& [n, height_s] : {std::pair{"1", one_s}, {"6", six_s}})
    for (const auto* gap : {"80ms", "150ms"}) {
      auto& run = e.latency_plot.emplace_back();
      run.point.labels = {n, gap};
      run.figures = {
          {"safety.driven_s", 180}, {"virtual_s", 180}, {"offloaded_share", 1}};
      run.t_off_s = {gap == std::string_view{"80ms"} ? 1 : height_s};
    }
  e.latency_plot.back().ended_early = 3;
  e.latency_plot.back().ended_late = ended_late;
  e.in_area.push_back(driven(dir / "in_area", 0, 10, "local"));
  return e;
}

/// Runs of one and of six vehicles with these mean latencies.
inline paper_runs two_latencies(const scratch& dir, double one_ms,
                                double six_ms) {
  write(dir / "distributions.csv", "service,figure,up_to_ms,count\n"
                                   "trajectory_planning,latency,60.000,1\n"
                                   "trajectory_planning,latency,10.000,3\n");
  paper_runs e;
  for (const auto& [n, mean_ms] : {std::pair{"1", one_ms}, {"6", six_ms}}) {
    auto& run = e.latency_plot.emplace_back();
    run.point.labels = {n, "100ms"};
    run.folder = dir.path();
    run.figures = {{"latency_ms.count", 4},      {"latency_ms.mean", mean_ms},
                   {"latency_ms.std", 9.8},      {"interarrival_ms.count", 4},
                   {"interarrival_ms.mean", 50}, {"interarrival_ms.std", 1}};
  }
  e.delay_plot = e.latency_plot;
  for (auto& run : e.delay_plot)
    run.point.labels.pop_back();
  return e;
}

} // namespace sofof::experiments::study::made_up
