// A leaderboard on a console.
#pragma once

#include "experiments/benchmark/decision_costs.hpp"
#include "experiments/benchmark/leaderboard.hpp"

#include <span>
#include <string>

namespace sofof::experiments::bench {

/// @param colour  The console is a terminal: the best of each column in bold.
/// @returns a table with a line for each entrant; columns of which nobody has a
/// figure are left out. Who is below the line stands below a line.
std::string board_text(const leaderboard& board,
                       std::span<const decision_cost> costs, bool colour);

} // namespace sofof::experiments::bench
