// A leaderboard on a console.
#include "experiments/benchmark/board_text.hpp"

#include "base/text/terminal_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace sofof::experiments::bench {

namespace {

constexpr auto unknown = "-";
constexpr std::size_t gap = 2;

struct cell {
  std::string text;
  bool best = false;
};

/// A column: its head, and a cell for each standing.
struct column {
  std::string head;
  std::vector<cell> cells;

  std::size_t width() const {
    auto widest = width_of(head);
    for (const auto& one : cells)
      widest = std::max(widest, width_of(one.text));
    return widest;
  }
};

column names_in(const leaderboard& board) {
  column all{"policy", {}};
  for (const auto& one : board.standings)
    all.cells.push_back({one.entrant, false});
  return all;
}

/// @returns nullopt if nobody has such a figure.
std::optional<column> figures_in(const leaderboard& board,
                                 const criterion& by) {
  column all{std::string{by.brief}, {}};
  const auto* best = best_of(board, by);
  bool any = false;
  for (const auto& one : board.standings) {
    const auto found = one.values.find(by.name);
    const auto known = found != one.values.end();
    any |= known;
    all.cells.push_back(
        {known ? fmt::format("{:.{}f}", found->second.mean, by.decimals)
               : unknown,
         known && best && one.above_line()
             && found->second.mean == best->mean});
  }
  return any ? std::optional{all} : std::nullopt;
}

column times_in(const leaderboard& board,
                std::span<const decision_cost> costs) {
  column all{"decide us", {}};
  for (const auto& one : board.standings) {
    const auto us = slowest_p50_us(costs, one.entrant, board.scenario);
    all.cells.push_back({us ? fmt::format("{:.1f}", *us) : unknown, false});
  }
  return all;
}

std::vector<column> columns_of(const leaderboard& board,
                               std::span<const decision_cost> costs) {
  std::vector<column> all{names_in(board)};
  for (const auto& by : criteria()) {
    if (by.name == score_name) // the last but one
      all.push_back(times_in(board, costs));
    if (!by.brief.empty())
      if (auto figures = figures_in(board, by))
        all.push_back(*std::move(figures));
  }
  return all;
}

/// @returns a line for each of those ranked whom almost everything is refused:
/// other columns say nothing of such a policy.
std::string idle_in(const leaderboard& board) {
  constexpr std::string_view refused = "rejected_percent";
  constexpr double most = 50; // of the requests
  std::string text;
  for (const auto& one : board.above()) {
    const auto found = one.values.find(refused);
    if (!offloads(one) && found != one.values.end()
        && found->second.mean >= most)
      text += fmt::format("{} offloads nothing: {:.0f} % of its requests are "
                          "refused.\n",
                          one.entrant, found->second.mean);
  }
  return text;
}

/// Names to the left, figures to the right.
std::string padded(const std::string& text, std::size_t width, bool first) {
  const std::string room(width - width_of(text), ' ');
  return first ? text + room : std::string(gap, ' ') + room + text;
}

} // namespace

std::string board_text(const leaderboard& board,
                       std::span<const decision_cost> costs, bool colour) {
  const terminal_style paint{colour};
  const auto columns = columns_of(board, costs);
  std::string head;
  for (const auto& one : columns)
    head += padded(one.head, one.width(), &one == &columns.front());
  auto text = paint.heading(head) + '\n';
  const auto ranked = board.above().size();
  for (std::size_t i = 0; i < board.standings.size(); ++i) {
    if (i == ranked)
      text += std::string(width_of(head), '-') + '\n';
    for (const auto& one : columns) {
      const auto part =
          padded(one.cells[i].text, one.width(), &one == &columns.front());
      text += one.cells[i].best ? paint.heading(part) : part;
    }
    text += '\n';
  }
  return text + idle_in(board);
}

} // namespace sofof::experiments::bench
