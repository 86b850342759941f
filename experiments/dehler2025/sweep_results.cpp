// Axes are the columns between the point and the seed.
#include "experiments/dehler2025/sweep_results.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "base/text/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace sofof::experiments::study {

namespace {

constexpr std::string_view before_axes = "point", behind_axes = "seed";

std::vector<std::string> columns_of(const std::filesystem::path& table) {
  const auto text = read_text(table, longest_results).value_or("");
  const auto header = std::string_view{text}.substr(0, text.find('\n'));
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= header.size();) {
    const auto comma = std::min(header.find(',', at), header.size());
    names.emplace_back(header.substr(at, comma - at));
    at = comma + 1;
  }
  return names;
}

std::vector<std::string> axes_of(const std::filesystem::path& table) {
  const auto columns = columns_of(table);
  const auto seed = std::ranges::find(columns, behind_axes);
  if (columns.front() != before_axes || seed == columns.end())
    throw input_error{fmt::format(
        "{}: this is no table of a sweep: its first columns should be \"{}\", "
        "the axes, and \"{}\".",
        table.string(), before_axes, behind_axes)};
  return {columns.begin() + 1, seed};
}

} // namespace

std::vector<measured_run> runs_of(const sweep_plan& plan,
                                  const sweep_outcome& outcome) {
  const auto points = points_of(plan);
  std::vector<measured_run> runs;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!outcome.folders[i].empty())
      runs.push_back(read_run(points[i], outcome.folders[i]));
  return runs;
}

bool is_sweep_table(const std::filesystem::path& file) {
  return columns_of(file).front() == before_axes;
}

sweep_results read_swept(const std::filesystem::path& table) {
  sweep_results all{table.stem().string(), axes_of(table), {}, 0, 0};
  std::vector<std::string_view> wanted{"seed", "status", "run"};
  wanted.insert(wanted.end(), all.axes.begin(), all.axes.end());
  csv_reader rows{table, wanted};
  while (rows.next()) {
    if (rows.text(1) == "failed") {
      ++all.failed;
      continue;
    }
    all.unsafe += rows.text(1) == "unsafe" ? 1U : 0U;
    sweep_point point{{}, static_cast<std::int64_t>(rows.number(0)), {}};
    for (std::size_t i = 0; i < all.axes.size(); ++i)
      point.labels.push_back(rows.text(wanted.size() - all.axes.size() + i));
    const auto& run = rows.text(2);
    if (run.empty() || run.find_first_not_of("0123456789abcdef") != run.npos)
      rows.refuse(2, "is no name of a run");
    all.runs.push_back(read_run(point, table.parent_path() / "runs" / run));
  }
  return all;
}

} // namespace sofof::experiments::study
