// Leaderboards as a report.
#include "experiments/benchmark/board_page.hpp"

#include "experiments/report/documented.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace sofof::experiments::bench {

namespace {

constexpr auto absent = "–";
constexpr std::string_view who = "a pair of policies";
constexpr std::string_view across = "violations_per_h";
constexpr std::string_view upwards = "energy_saved_percent";
/// Nobody above the line has any of these.
constexpr std::string_view of_safety[] = {"without_plan_s_per_h", "collisions"};
/// Beside the score, with brief heads; the rest stands further down.
constexpr std::string_view beside_score[] = {
    "offloaded_percent", across, "latency_p99_ms", upwards, regret_name};
/// So many columns with whole titles fit on a page.
constexpr std::size_t most_columns = 7;

template <class Names>
bool is_one_of(std::string_view name, const Names& names) {
  return std::ranges::find(names, name) != std::end(names);
}

const criterion& criterion_of(std::string_view name) {
  return *std::ranges::find(criteria(), name, &criterion::name);
}

void add_column(report::table& t, std::string_view title,
                std::string_view meaning) {
  t.columns.emplace_back(title);
  t.column_meanings.emplace_back(meaning);
}

void add_column(report::table& t, std::string_view title, const criterion& by) {
  add_column(
      t, title,
      report::documented_in(report::bench_page, "What is measured", by.name));
}

std::string text_of(const standing& one, const criterion& by) {
  const auto found = one.values.find(by.name);
  return found != one.values.end()
             ? fmt::format("{:.{}f}", found->second.mean, by.decimals)
             : absent;
}

bool has(const leaderboard& board, std::string_view name) {
  return std::ranges::any_of(board.standings, [name](const auto& one) {
    return one.values.contains(name);
  });
}

/// @returns the criteria, of those beside the score or of the others, by which
/// anybody has a figure; without those that have an interval.
std::vector<criterion> shown_of(const leaderboard& board, bool beside) {
  std::vector<criterion> all;
  for (const auto& by : criteria())
    if (by.name != score_name && by.name != than_location_name
        && is_one_of(by.name, beside_score) == beside
        && !is_one_of(by.name, of_safety) && has(board, by.name))
      all.push_back(by);
  return all;
}

std::string interval_of(const standing& one, std::string_view name) {
  const auto found = one.values.find(name);
  if (found == one.values.end() || one.seeds < 2)
    return absent;
  const auto places = criterion_of(name).decimals;
  return fmt::format("{:.{}f} … {:.{}f}", found->second.low, places,
                     found->second.high, places);
}

report::table ranking(const leaderboard& board) {
  report::table t;
  const auto shown = shown_of(board, true);
  std::vector<std::string_view> compared{score_name};
  if (has(board, than_location_name))
    compared.push_back(than_location_name);
  add_column(t, "", "the place, by the score");
  add_column(t, "entrant", who);
  for (const auto name : compared) {
    add_column(t, criterion_of(name).title, criterion_of(name));
    add_column(t, "95 % interval", "of the mean before it, over seeds");
  }
  for (const auto& by : shown)
    add_column(t, by.brief, by);
  std::size_t place = 0;
  for (const auto& one : board.above()) {
    std::vector<std::string> row{
        fmt::format("{}{}", ++place, one.tied ? " =" : ""), one.entrant};
    for (const auto name : compared) {
      row.push_back(text_of(one, criterion_of(name)));
      row.push_back(interval_of(one, name));
    }
    for (const auto& by : shown)
      row.push_back(text_of(one, by));
    t.rows.push_back(std::move(row));
  }
  t.note = "=: tied with the one above, as the 95 % interval of the difference "
           "of their scores, run by run, holds 0. Means over all runs: the "
           "score; how much it is above that of the "
           "entrant location, run by run; the offloaded share; QoS violations "
           "per hour of driving; the 99 % quantile of latency; energy saved; "
           "and how much the score is above the oracle's.";
  return t;
}

std::string time_of(const standing& one, const leaderboard& board,
                    std::span<const decision_cost> costs) {
  const auto us = slowest_p99_us(costs, one.entrant, board.scenario);
  return us ? fmt::format("{:.1f}", *us) : absent;
}

/// @returns tables that are no wider than a page; the times are in the first.
std::vector<report::table> other_figures(const leaderboard& board,
                                         std::span<const decision_cost> costs) {
  const auto shown = shown_of(board, false);
  std::vector<report::table> all;
  for (std::size_t from = 0; all.empty() || from < shown.size();) {
    auto& t = all.emplace_back();
    add_column(t, "entrant", who);
    const auto first = all.size() == 1;
    if (first) {
      t.title = "Other figures";
      add_column(t, "time to decide, 99 %, µs",
                 "of LODM or CODM, whichever takes longer");
    }
    const auto to =
        std::min(shown.size(), from + most_columns - t.columns.size());
    for (auto i = from; i < to; ++i)
      add_column(t, shown[i].title, shown[i]);
    for (const auto& one : board.above()) {
      auto& row = t.rows.emplace_back();
      row.push_back(one.entrant);
      if (first)
        row.push_back(time_of(one, board, costs));
      for (auto i = from; i < to; ++i)
        row.push_back(text_of(one, shown[i]));
    }
    from = to;
  }
  return all;
}

report::table below_the_line(const leaderboard& board) {
  report::table t;
  t.title = "Below the line";
  add_column(t, "entrant", who);
  add_column(t, "unsafe runs",
             "in which somebody drove without a fresh plan, left the road or "
             "touched somebody");
  add_column(t, "failed runs", "without a result");
  add_column(t, "of", "all runs of the entrant");
  std::vector<std::string_view> shown{score_name};
  shown.insert(shown.end(), std::begin(of_safety), std::end(of_safety));
  for (const auto name : shown)
    add_column(t, criterion_of(name).title, criterion_of(name));
  for (const auto& one : board.below()) {
    auto& row = t.rows.emplace_back();
    row = {one.entrant, std::to_string(one.unsafe), std::to_string(one.failed),
           std::to_string(one.runs + one.failed)};
    for (const auto name : shown)
      row.push_back(text_of(one, criterion_of(name)));
  }
  t.note = "Not ranked: a run had no result, or in it somebody drove without a "
           "fresh plan, left the road or touched somebody. Collisions are the "
           "mean of a run.";
  return t;
}

/// One seed alone has none.
std::optional<std::pair<double, double>> ends_of(const standing& one,
                                                 std::string_view name) {
  if (one.seeds < 2)
    return std::nullopt;
  const auto& value = one.values.at(name);
  return std::pair{value.low, value.high};
}

report::scatter trade_off(const leaderboard& board) {
  report::scatter s;
  s.title = "Energy saved against violations";
  s.x_label = criterion_of(across).title;
  s.y_label = criterion_of(upwards).title;
  std::vector<double> x, y; // of those above the line, who come first
  for (const auto& one : board.standings) {
    const auto at_x = one.values.find(across), at_y = one.values.find(upwards);
    if (at_x == one.values.end() || at_y == one.values.end())
      continue;
    const auto& dot = s.dots.emplace_back(report::scatter::dot{
        one.entrant, at_x->second.mean, at_y->second.mean, !one.above_line(),
        ends_of(one, across), ends_of(one, upwards)});
    if (dot.hollow)
      continue;
    x.push_back(dot.x);
    y.push_back(dot.y);
  }
  s.joined = pareto_front(x, y);
  s.caption = "Up and to the left is better. The line joins those that nobody "
              "beats in both; a ring is below the line. Bars are intervals of "
              "95 %.";
  return s;
}

void add_board(report::section& to, const leaderboard& board,
               std::span<const decision_cost> costs) {
  if (!board.above().empty())
    to.blocks.emplace_back(ranking(board));
  if (!board.below().empty())
    to.blocks.emplace_back(below_the_line(board));
  if (auto plane = trade_off(board); !plane.dots.empty())
    to.blocks.emplace_back(std::move(plane));
  if (!board.above().empty())
    for (auto& figures : other_figures(board, costs))
      to.blocks.emplace_back(std::move(figures));
}

report::section overall(const leaderboard& board, std::size_t scenarios,
                        std::span<const decision_cost> costs) {
  report::section s{"Leaderboard", {}};
  s.blocks.emplace_back(report::paragraph{fmt::format(
      "{} entrants in {} scenario{}, every one of them on the same noise. The "
      "score is the mean cost of a planning cycle, of time, energy and "
      "violations; less is better. Intervals are of 95 %, over seeds. "
      "docs/bench.md says what each figure is; `leaderboard.csv` has "
      "all of them with their intervals.",
      board.standings.size(), scenarios, scenarios == 1 ? "" : "s")});
  add_board(s, board, costs);
  return s;
}

report::section about(std::span<const entrant> entrants) {
  report::section s{"Entrants", {}};
  report::table t;
  add_column(t, "entrant", who);
  add_column(t, "LODM", "decides in the vehicle");
  add_column(t, "CODM", "decides at the provider");
  for (const auto& one : entrants)
    t.rows.push_back({one.name, one.lodm, one.codm});
  s.blocks.emplace_back(std::move(t));
  return s;
}

} // namespace

std::vector<std::size_t> pareto_front(std::span<const double> x,
                                      std::span<const double> y) {
  assert(x.size() == y.size());
  std::vector<std::size_t> order(x.size()), front;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    return std::pair{x[i], -y[i]};
  });
  auto highest = -std::numeric_limits<double>::infinity();
  for (const auto i : order)
    if (y[i] > highest) {
      highest = y[i];
      front.push_back(i);
    }
  return front;
}

report::document board_page(std::span<const leaderboard> boards,
                            std::span<const decision_cost> costs,
                            std::span<const entrant> entrants,
                            std::string subtitle) {
  assert(!boards.empty());
  report::document all;
  all.title = "Who offloads best";
  all.subtitle = std::move(subtitle);
  all.sections.push_back(overall(boards.front(), boards.size() - 1, costs));
  for (const auto& board : boards.subspan(1)) {
    auto& section =
        all.sections.emplace_back(report::section{board.scenario, {}});
    add_board(section, board, costs);
  }
  all.sections.push_back(about(entrants));
  return all;
}

} // namespace sofof::experiments::bench
