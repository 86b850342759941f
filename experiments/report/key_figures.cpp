// Puts the figures of summaries side by side.
#include "experiments/report/key_figures.hpp"

#include "experiments/report/comparison.hpp"
#include "experiments/report/documented.hpp"
#include "recording/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
    if (runs.size() == 2) {
      table_.columns.emplace_back("difference");
      both_.emplace(runs);
    }
  }

  void add(const recording::reported_figure& x,
           const std::string& prefix = "") {
    add({.member = std::string{x.name},
         .prefix = prefix,
         .name = std::string{x.how.title},
         .meaning = documented("summary.json", x.name),
         .decimals = x.how.decimals,
         .scale = x.how.scale});
  }

  struct row_of_figure {
    std::string member; ///< Without `prefix`, which stands before it.
    std::string prefix{};
    std::string name;
    std::string meaning{};
    int decimals = 0;
    double scale = 1;
  };

  void add(const row_of_figure& x) {
    std::vector<std::string> row{x.name};
    std::vector<double> values;
    for (const auto& run : runs_) {
      const auto value = run.figure(x.prefix + x.member);
      row.push_back(value ? fmt::format("{:.{}f}", *value * x.scale, x.decimals)
                          : "–");
      if (value)
        values.push_back(*value * x.scale);
    }
    if (values.empty())
      return;
    if (both_)
      compare(x, row, values);
    table_.rows.push_back(std::move(row));
    table_.row_meanings.push_back(x.meaning);
  }

  void finish(std::vector<table>& all) && {
    if (!table_.rows.empty())
      all.push_back(std::move(table_));
  }

private:
  void compare(const row_of_figure& x, std::vector<std::string>& row,
               const std::vector<double>& values) {
    if (values.size() < 2) {
      row.emplace_back("–");
      table_.verdicts.push_back(table::verdict::different);
      return;
    }
    const auto alike = row[1] == row[2];
    row.push_back(
        both_->difference(x.member, values[0], values[1], x.decimals));
    table_.verdicts.push_back(
        alike && row[3] == "0"
            ? table::verdict::same
            : both_->verdict(x.member, values[0], values[1]));
  }

  std::span<const recorded_run> runs_;
  std::optional<comparison> both_;
  table table_;
};

void add_table(std::vector<table>& all, std::span<const recorded_run> runs,
               std::string title, recording::report_table which) {
  figure_table shown{runs, std::move(title)};
  for (const auto& figure : recording::reported_in(which))
    shown.add(figure);
  std::move(shown).finish(all);
}

/// Near misses stand in each such table, wherever the list of figures puts
/// them.
void add_safety(std::vector<table>& all, std::span<const recorded_run> runs) {
  figure_table shown{runs, "Safety, comfort and energy"};
  constexpr std::string_view near_misses = "safety.near_misses";
  const auto figures = recording::reported_in(recording::report_table::safety);
  const auto listed = std::ranges::find(figures, near_misses,
                                        &recording::reported_figure::name);
  if (listed == figures.end())
    shown.add({.member = std::string{near_misses},
               .name = "near misses",
               .meaning = documented("summary.json", near_misses)});
  for (const auto& figure : figures)
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
  for (const auto& member : members) {
    const auto reason = member.substr(prefix.size());
    to.add({.member = "ended_by." + reason,
            .prefix = prefix.substr(0, prefix.rfind("ended_by.")),
            .name = "ended by " + reason,
            .meaning = documented("Reasons", reason)});
  }
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
    to.add(
        {.member = "implausible." + name,
         .prefix = prefix.substr(0, prefix.rfind("implausible.")),
         .name = fmt::format("implausible results of {}: {}",
                             name.substr(0, dot), name.substr(dot + 1)),
         .meaning = documented("Implausible results", name.substr(dot + 1))});
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
  add_safety(all, runs);
  add_table(all, runs, "Traffic", recording::report_table::traffic);
  add_table(all, runs, "On the air", recording::report_table::air);
  return all;
}

} // namespace sofof::experiments::report
