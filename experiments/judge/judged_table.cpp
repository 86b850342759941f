// What was judged, for people and for programs.
#include "experiments/judge/judged_table.hpp"

#include "base/text/csv.hpp"
#include "base/text/printable.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace sofof::experiments::judge {

namespace {

constexpr std::array<std::string_view, 6> meanings{
    "the goal's place, time, speed and heading, all at one step",
    "with an obstacle, before the goal",
    "a corner of the vehicle was off all lanelets, before the goal",
    "never in a goal when it should be",
    "no lanes lead there",
    "the file is wrong"};

std::string result_of(const judged& row) {
  if (row.found.what == outcome::reached && !row.limit.empty())
    return "reached, beyond limits";
  return std::string{name_of(row.found.what)};
}

std::string reason_of(const judged& row) {
  return printable(row.limit.empty() ? row.found.why : row.limit);
}

bool was_driven(const judged& row) {
  return row.found.what < outcome::no_route;
}

std::string time_of(const judged& row) {
  return was_driven(row) ? fmt::format("{:.1f}", row.found.at_s) : "";
}

double share(std::size_t part, std::size_t all) {
  return all == 0 ? 0
                  : 100 * static_cast<double>(part) / static_cast<double>(all);
}

} // namespace

std::string table_head() {
  return fmt::format("{:<32} {:<8} {:<10} {:>6}  {}\n", "scenario", "problem",
                     "result", "at s", "reason");
}

std::string table_line(const judged& row) {
  auto text = fmt::format("{:<32} {:<8} {:<10} {:>6}  {}",
                          printable(row.scenario), printable(row.problem),
                          result_of(row), time_of(row), reason_of(row));
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

std::string summary(std::span<const judged> rows) {
  const judged_counts counts{rows};
  auto text = fmt::format("{} planning problem{}: ", counts.all,
                          counts.all == 1 ? "" : "s");
  auto first = true;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(last_outcome); ++i) {
    const auto what = static_cast<outcome>(i);
    if (counts.of(what) == 0)
      continue;
    text +=
        fmt::format("{}{} {} ({:.1f} %)", first ? "" : ", ", counts.of(what),
                    name_of(what), share(counts.of(what), counts.all));
    first = false;
  }
  return text
         + fmt::format("\ncollisions by own fault: {}\n", counts.own_fault);
}

std::string to_csv(std::span<const judged> rows) {
  std::string text = "file,scenario,problem,result,own_fault,at_s,way_m,within_"
                     "limits,solution,reason\n";
  for (const auto& row : rows) {
    const auto add = [&text](std::string_view field) {
      append(text, field);
      text += ',';
    };
    add(row.file);
    add(printable(row.scenario));
    add(printable(row.problem));
    add(name_of(row.found.what));
    add(row.found.own_fault ? "1" : "0");
    add(was_driven(row) ? fmt::format("{:.3f}", row.found.at_s) : "");
    add(was_driven(row) ? fmt::format("{:.3f}", row.way_m) : "");
    add(row.found.what != outcome::reached ? ""
        : row.limit.empty()                ? "1"
                                           : "0");
    add(row.solution);
    append(text, std::string_view{reason_of(row)});
    text += '\n';
  }
  return text;
}

report::document judged_page(std::span<const judged> rows) {
  const judged_counts counts{rows};
  report::document page;
  page.title = "Scenarios judged";
  page.subtitle = fmt::format("{} planning problems of CommonRoad, driven by "
                              "the trajectory planner",
                              counts.all);
  report::table results{.title = "Results",
                        .columns = {"result", "problems", "share, %"},
                        .rows = {}};
  for (std::size_t i = 0; i <= static_cast<std::size_t>(last_outcome); ++i) {
    const auto what = static_cast<outcome>(i);
    results.rows.push_back(
        {std::string{name_of(what)}, fmt::format("{}", counts.of(what)),
         fmt::format("{:.1f}", share(counts.of(what), counts.all))});
    results.row_meanings.emplace_back(meanings[i]);
  }
  results.note = fmt::format("The first of these that happens counts. "
                             "Collisions by own fault: {}.",
                             counts.own_fault);
  report::table all{
      .title = "Planning problems",
      .columns = {"scenario", "problem", "result", "at, s", "way, m", "reason"},
      .rows = {}};
  all.column_meanings = {
      "its benchmark id",    "its id in the file",
      "what happened first", "after the begin of the drive",
      "driven until then",   "why, and whose fault a collision is"};
  for (const auto& row : rows)
    all.rows.push_back({printable(row.scenario), printable(row.problem),
                        result_of(row), time_of(row),
                        was_driven(row) ? fmt::format("{:.1f}", row.way_m) : "",
                        reason_of(row)});
  page.sections.push_back(
      {"Results",
       {report::paragraph{"`docs/judge.md` says what each result means. "
                          "`judge.csv` has the same rows; each problem's "
                          "scenario stands beside, for `sofof run`."},
        std::move(results)}});
  page.sections.push_back({"Planning problems", {std::move(all)}});
  return page;
}

} // namespace sofof::experiments::judge
