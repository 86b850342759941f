// Puts the figures of summaries side by side.
#include "experiments/report/key_figures.hpp"

#include "recording/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace sofof::experiments::report {

namespace {

class figure_table {
public:
  figure_table(std::span<const recorded_run> runs, std::string title)
      : runs_{runs} {
    table_.title = std::move(title);
    table_.columns.emplace_back("figure");
    for (const auto& run : runs)
      table_.columns.push_back(runs.size() == 1 ? "value" : run.label);
    if (runs.size() == 2)
      table_.columns.emplace_back("difference");
  }

  void add(const recording::reported_figure& x,
           const std::string& prefix = "") {
    add(prefix + std::string{x.name}, x.how.title, x.how.decimals, x.how.scale);
  }

  void add(const std::string& member, std::string_view name, int decimals = 0,
           double scale = 1) {
    std::vector<std::string> row{std::string{name}};
    std::vector<double> values;
    for (const auto& run : runs_) {
      const auto value = run.figure(member);
      row.push_back(value ? fmt::format("{:.{}f}", *value * scale, decimals)
                          : "–");
      if (value)
        values.push_back(*value * scale);
    }
    if (values.empty())
      return;
    if (runs_.size() == 2)
      row.push_back(values.size() == 2
                        ? difference(values[1] - values[0], decimals)
                        : "–");
    table_.rows.push_back(std::move(row));
  }

  void finish(std::vector<table>& all) && {
    if (!table_.rows.empty())
      all.push_back(std::move(table_));
  }

private:
  static std::string difference(double x, int decimals) {
    const auto text = fmt::format("{:+.{}f}", x, decimals);
    const auto nothing = text.find_first_of("123456789") == text.npos;
    return nothing ? "0" : text;
  }

  std::span<const recorded_run> runs_;
  table table_;
};

void add_table(std::vector<table>& all, std::span<const recorded_run> runs,
               std::string title, recording::report_table which) {
  figure_table shown{runs, std::move(title)};
  for (const auto& figure : recording::reported_in(which))
    shown.add(figure);
  std::move(shown).finish(all);
}

/// Adds why offloadings ended, as far as any did so.
void add_endings(figure_table& to, std::span<const recorded_run> runs,
                 const std::string& prefix) {
  std::set<std::string> members;
  for (const auto& run : runs)
    if (run.figures)
      for (const auto& [member, count] : *run.figures)
        if (member.starts_with(prefix) && count > 0)
          members.insert(member);
  for (const auto& member : members)
    to.add(member, "ended by " + member.substr(prefix.size()));
}

/// Adds whose results were refused, by check: PROVIDER.CHECK.
void add_refusals(figure_table& to, std::span<const recorded_run> runs,
                  const std::string& prefix) {
  std::set<std::string> members;
  for (const auto& run : runs)
    if (run.figures)
      for (const auto& [member, count] : *run.figures)
        if (member.starts_with(prefix))
          members.insert(member);
  for (const auto& member : members) {
    const auto name = member.substr(prefix.size());
    const auto dot = name.rfind('.');
    to.add(member, fmt::format("implausible results of {}: {}",
                               name.substr(0, dot), name.substr(dot + 1)));
  }
}

} // namespace

std::vector<table> key_figures(std::span<const recorded_run> runs) {
  std::vector<table> all;
  add_table(all, runs, "The run", recording::report_table::run);
  for (const auto& service : services_of(runs)) {
    const auto prefix = "services." + service + '.';
    figure_table shown{runs, "Offloading of " + service};
    for (const auto& figure :
         recording::reported_in(recording::report_table::service))
      shown.add(figure, prefix);
    add_endings(shown, runs, prefix + "ended_by.");
    add_refusals(shown, runs, prefix + "implausible.");
    std::move(shown).finish(all);
  }
  add_table(all, runs, "Safety and comfort", recording::report_table::safety);
  add_table(all, runs, "On the air", recording::report_table::air);
  return all;
}

} // namespace sofof::experiments::report
