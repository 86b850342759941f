// From the splits of summary.json.
#include "experiments/report/energy_section.hpp"

#include "experiments/report/documented.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::experiments::report {

namespace {

struct energy_column {
  std::string_view name;
  std::string_view title;
  int decimals;
};

constexpr energy_column energy_columns[]{
    {"driven_s", "driven, s", 1},
    {"vehicle_j", "vehicle, J", 2},
    {"radio_j", "radio, J", 3},
    {"server_j", "servers, J", 2},
    {"home_j", "all at home, J", 2},
    {"saved_j", "saved, J", 2},
    {"saved_per_km_j", "saved, J/km", 2},
    {"break_even_w", "breaks even at, W", 2},
};

constexpr std::string_view first_member = ".driven_s";
constexpr std::string_view splits_prefix = "splits.";

/// @returns "trajectory_planning.vehicle>mec" of each split.
std::vector<std::string> splits_in(const recorded_run& run) {
  std::vector<std::string> all;
  if (run.figures)
    for (const auto& [name, value] : *run.figures)
      if (name.starts_with(splits_prefix) && name.ends_with(first_member))
        all.push_back(
            name.substr(splits_prefix.size(), name.size() - splits_prefix.size()
                                                  - first_member.size()));
  return all;
}

bool is_offloaded(const recorded_run& run) {
  return run.figures && std::ranges::any_of(*run.figures, [](const auto& x) {
           return x.first.starts_with(splits_prefix)
                  && x.first.ends_with(".server_j") && x.second > 0;
         });
}

table splits_of(const recorded_run& run) {
  table all;
  all.columns = {"chain", "split"};
  all.column_meanings = {documented("energy.csv", "chain"),
                         documented("energy.csv", "split")};
  for (const auto& column : energy_columns) {
    all.columns.emplace_back(column.title);
    all.column_meanings.push_back(documented(
        "summary.json", fmt::format("splits.any.any.{}", column.name)));
  }
  for (const auto& split : splits_in(run)) {
    const auto dot = split.find('.');
    auto& row = all.rows.emplace_back();
    row = {split.substr(0, dot), split.substr(dot + 1)};
    for (const auto& column : energy_columns) {
      const auto value =
          run.figure(fmt::format("{}{}.{}", splits_prefix, split, column.name));
      row.push_back(value ? fmt::format("{:.{}f}", *value, column.decimals)
                          : "–");
    }
  }
  return all;
}

} // namespace

section energy_section(std::span<const recorded_run> runs) {
  section all{.title = "Energy of both ends", .blocks = {}};
  for (const auto& run : runs) {
    auto one = splits_of(run);
    if (!is_offloaded(run))
      continue;
    if (runs.size() > 1)
      one.title = run.label;
    all.blocks.emplace_back(std::move(one));
  }
  return all;
}

} // namespace sofof::experiments::report
