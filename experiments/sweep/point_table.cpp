// From nested summaries to flat lines.
#include "experiments/sweep/point_table.hpp"

#include "base/text/csv.hpp"
#include "recording/safety_line.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace sofof::experiments {

namespace {

using nlohmann::ordered_json;

constexpr std::string_view wall_clock = "timing"; // a member with its figures

/// The columns of figures, in the order in which they are first met.
class figure_columns {
public:
  std::size_t of(const std::string& path) {
    const auto [at, is_new] = places_.try_emplace(path, paths_.size());
    if (is_new)
      paths_.push_back(path);
    return at->second;
  }
  const std::vector<std::string>& paths() const { return paths_; }

private:
  std::map<std::string, std::size_t> places_;
  std::vector<std::string> paths_;
};

std::string text_of(const ordered_json& value) {
  if (value.is_null())
    return "";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// @returns the members that differ from run to run, and those that stand in
/// other columns.
std::set<std::string> left_out(const sweep_plan& plan) {
  std::set<std::string> members{"wall_s", "seed", "interrupted"};
  for (const auto& axis : plan.axes)
    members.insert(axis.name);
  return members;
}

void flatten(const ordered_json& object, const std::string& prefix,
             const std::set<std::string>& without, figure_columns& columns,
             std::map<std::size_t, std::string>& row) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object() ? prefix + key == wall_clock
                          : without.contains(prefix + key))
      continue;
    if (value.is_object())
      flatten(value, prefix + key + '.', without, columns, row);
    else
      row[columns.of(prefix + key)] = text_of(value);
  }
}

void append_cell(std::string& line, std::string_view text) {
  line += ',';
  append(line, text);
}

} // namespace

bool point_result::safe() const {
  const auto summary = ordered_json::parse(this->summary);
  return recording::is_safe([&summary](const std::string& name) {
    auto path = '/' + name;
    std::ranges::replace(path, '.', '/');
    return summary.at(ordered_json::json_pointer{path}).get<double>();
  });
}

void run_counts::add(const point_result& result) {
  ++(result.failed() ? failed : result.safe() ? good : unsafe);
}

std::string point_table(const sweep_plan& plan,
                        const std::vector<point_result>& results) {
  const auto without = left_out(plan);
  figure_columns columns;
  std::vector<std::map<std::size_t, std::string>> figures(results.size());
  for (std::size_t i = 0; i < results.size(); ++i)
    if (!results[i].failed())
      flatten(ordered_json::parse(results[i].summary), "", without, columns,
              figures[i]);

  std::string text = "point";
  for (const auto& axis : plan.axes)
    append_cell(text, axis.name);
  text += ",seed,status,run";
  for (const auto& path : columns.paths())
    append_cell(text, path);
  text += '\n';

  const auto points = points_of(plan);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& result = results.at(i);
    text += fmt::format("{}", i + 1);
    for (const auto& label : points[i].labels)
      append_cell(text, label);
    text += fmt::format(",{},{},{}", points[i].seed,
                        result.failed() ? "failed"
                        : result.safe() ? "ok"
                                        : "unsafe",
                        result.run);
    for (std::size_t k = 0; k < columns.paths().size(); ++k) {
      const auto found = figures[i].find(k);
      append_cell(text, found != figures[i].end() ? found->second : "");
    }
    text += '\n';
  }
  return text;
}

} // namespace sofof::experiments
