// Leaderboards as a report.
#pragma once

#include "experiments/benchmark/decision_costs.hpp"
#include "experiments/benchmark/leaderboard.hpp"
#include "experiments/report/document.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sofof::experiments::bench {

/// @param x, y  Of as many points; less x and more y is better.
/// @returns the numbers of those that no other point beats, by ascending x; of
/// equal ones the first.
/// Source: Pareto, Manuale di economia politica, 1906.
std::vector<std::size_t> pareto_front(std::span<const double> x,
                                      std::span<const double> y);

/// @param boards    The first is of all scenarios together.
/// @param subtitle  What was run.
report::document board_page(std::span<const leaderboard> boards,
                            std::span<const decision_cost> costs,
                            std::span<const entrant> entrants,
                            std::string subtitle);

} // namespace sofof::experiments::bench
