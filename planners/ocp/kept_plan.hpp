// What of a solve the next one goes on from, apart from the workspace, which
// planners share.
#pragma once

#include "planners/ocp/workspace.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

namespace sofof::planners::ocp {

/// A plan and its multipliers, of as many knots as it has. Few multipliers are
/// not zero: only bounds that hold the plan have one.
struct kept_plan {
  static constexpr std::size_t most_rows = 6;
  struct multiplier {
    int row = 0, knot = 0;
    double y = 0; ///< Over the row's rho.
  };

  int steps = 0; ///< 0: there is none.
  double ds_m = 1;
  std::vector<double> knots; ///< x0, x1, x2 and u, one after the other.
  std::array<double, most_rows> rho{}; ///< By row.
  std::vector<multiplier> multipliers;

  bool is_empty() const { return steps == 0; }
};

/// Takes the plan out of a workspace.
template <class Problem>
void keep(const workspace<Problem>& w, double ds_m, kept_plan& out) {
  assert(w.is_sized() && ds_m > 0);
  out.steps = w.n;
  out.ds_m = ds_m;
  const auto knots = static_cast<std::size_t>(w.n) + 1;
  out.knots.resize(4 * knots);
  auto next = out.knots.begin();
  for (const auto* column : {&w.plan.x0, &w.plan.x1, &w.plan.x2, &w.plan.u})
    next = std::ranges::copy(w.knots(*column), next).out;
  assert(next == out.knots.end());
  out.rho.fill(1);
  out.multipliers.clear();
  out.multipliers.reserve(knots); // enough as a rule
  w.rows.each([&](const auto& row, int number) {
    assert(static_cast<std::size_t>(number) < out.rho.size());
    out.rho[static_cast<std::size_t>(number)] = row.rho;
    for (int k = 0; k <= w.n; ++k)
      if (row.y[k] != 0)
        out.multipliers.push_back({number, k, row.y[k]});
  });
}

/// Puts it back into a workspace in which all rows are open.
template <class Problem>
void restore(const kept_plan& from, workspace<Problem>& w) {
  assert(!from.is_empty() && from.steps <= most_steps);
  const auto knots = static_cast<std::size_t>(from.steps) + 1;
  assert(from.knots.size() == 4 * knots);
  w.n = from.steps;
  w.padded = padded(w.n + 1);
  auto next = from.knots.begin();
  for (auto* column : {&w.plan.x0, &w.plan.x1, &w.plan.x2, &w.plan.u}) {
    std::copy_n(next, knots, column->begin());
    next += static_cast<std::ptrdiff_t>(knots);
  }
  auto multiplier = from.multipliers.begin();
  w.rows.each([&](auto& row, int number) {
    row.rho = from.rho[static_cast<std::size_t>(number)];
    std::fill_n(row.y.begin(), knots, 0.0);
    for (; multiplier != from.multipliers.end() && multiplier->row == number;
         ++multiplier) {
      assert(multiplier->knot >= 0 && multiplier->knot <= from.steps);
      row.y[static_cast<std::size_t>(multiplier->knot)] = multiplier->y;
    }
  });
  assert(multiplier == from.multipliers.end());
}

/// Fills it with NaN where assertions are on, so that no solve goes on from
/// what another one has left.
template <class Problem>
void poison([[maybe_unused]] workspace<Problem>& w) {
#ifndef NDEBUG
  std::memset(static_cast<void*>(&w), 0xff, sizeof w);
  w.rows = typename Problem::row_set();
  w.rows.each([](auto& row, int) {
    for (auto* column :
         {&row.lo, &row.hi, &row.c, &row.y, &row.v, &row.active, &row.dc})
      column->fill(std::numeric_limits<double>::quiet_NaN());
  });
#endif
}

} // namespace sofof::planners::ocp
