// A plan and its multipliers on a grid, carried over to another: because the
// vehicle drives on, its horizon shrinks, or another planner takes over.
#pragma once

#include "planners/ocp/workspace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sofof::ocp {

/// A new grid, seen from the old one, in its steps.
struct regrid {
  double first;    ///< Where the new knot 0 is, >= 0.
  double step;     ///< Length of a new step, > 0.
  int last;        ///< The old last knot, >= 1 ...
  int last_of_new; ///< ... and the new one.

  /// @param by_m  How far the vehicle has driven, m, >= 0.
  static regrid after(double by_m, double old_ds_m, int old_steps, double ds_m,
                      int steps) {
    constexpr auto whole = 1e-6; // steps; what is closer is meant to be
    const auto by = by_m / old_ds_m, rounded = std::round(by);
    return {std::abs(by - rounded) < whole ? rounded : by, ds_m / old_ds_m,
            old_steps, steps};
  }

  /// @returns the same for numbers that belong to steps, not to knots.
  regrid of_steps() const {
    auto g = *this;
    g.first = std::max(0., first + (step - 1) / 2);
    return g;
  }
};

/// @returns whether a problem can be posed on this grid.
inline bool is_grid(double ds_m, int steps) {
  return steps >= 1 && steps <= most_steps && ds_m > 0 && std::isfinite(ds_m);
}

/// @returns whether a plan can be carried over to this grid.
inline bool can_move(double by_m, double ds_m, int steps) {
  return is_grid(ds_m, steps) && by_m >= 0 && std::isfinite(by_m);
}

/// @returns whether a plan on one grid is one on the other.
inline bool same_grid(double ds_m, int steps, double other_ds_m,
                      int other_steps) {
  constexpr auto rounding = 1e-9;
  return steps == other_steps && std::abs(ds_m - other_ds_m) <= rounding * ds_m;
}

/// Interpolates between knots.
/// @param scale  What the numbers are multiplied with.
/// @param tail   What is assumed beyond the old end.
inline void resample(column& c, const regrid& g, double scale, double tail) {
  const column old = c;
  // Knots as far apart as before: all are off by the same share.
  const auto even = g.step == 1;
  const auto known =
      std::clamp((g.last - g.first) / g.step + 1, 0., g.last_of_new + 1.);
  const auto end = static_cast<int>(known);
  const auto whole = static_cast<int>(std::min<double>(g.first, g.last));
  const double share = g.first - whole;
  int k = 0;
  for (; even && k < end - 1; ++k)
    c[k] = scale * ((1 - share) * old[k + whole] + share * old[k + whole + 1]);
  for (; k < end; ++k) {
    const double at = g.first + g.step * k;
    const int i = std::min(static_cast<int>(at), g.last - 1);
    c[k] = scale * ((1 - (at - i)) * old[i] + (at - i) * old[i + 1]);
  }
  for (; k <= g.last_of_new; ++k)
    c[k] = tail;
}

/// Multipliers grow with the length of their stage.
/// @param on_steps  The row whose bounds belong to steps, not to knots.
template <class Rows>
void resample_multipliers(Rows& rows, const regrid& g, int on_steps) {
  rows.each([&](auto& row, int index) {
    resample(row.y, index == on_steps ? g.of_steps() : g, g.step, 0);
  });
}

/// What a solver has to know to go on from the plan of another one. Plain
/// numbers, which may travel; of each column the first steps + 1 count.
/// @param bounds  How many rows the problem has.
template <std::size_t bounds>
struct warm_start {
  static constexpr auto rows = bounds;
  /// No planner has finer or coarser steps.
  static constexpr auto least_ds_m = 0.01, most_ds_m = 100.0;
  using column = std::array<float, capacity>;

  double ds_m = 0;
  int steps = 0; ///< 0: nothing is known.
  column x0{}, x1{}, x2{}, u{};
  std::array<column, rows> force{}; ///< Multipliers of the bounds.

  /// @returns whether this can be gone on from.
  bool usable() const {
    if (!is_grid(ds_m, steps) || ds_m < least_ds_m || ds_m > most_ds_m)
      return false;
    const auto finite = [this](const column& c) {
      return std::all_of(c.begin(), c.begin() + steps + 1,
                         [](float x) { return std::isfinite(x); });
    };
    return finite(x0) && finite(x1) && finite(x2) && finite(u)
           && std::all_of(force.begin(), force.end(), finite);
  }
};

/// @returns plan and multipliers of a workspace.
template <std::size_t rows, class Problem>
warm_start<rows> known(const workspace<Problem>& w, double ds_m) noexcept {
  warm_start<rows> memory{.ds_m = ds_m, .steps = w.n};
  const auto save = [n = w.n](auto& to, const column& from, double scale) {
    for (int k = 0; k <= n; ++k)
      to[static_cast<std::size_t>(k)] = static_cast<float>(scale * from[k]);
  };
  save(memory.x0, w.plan.x0, 1);
  save(memory.x1, w.plan.x1, 1);
  save(memory.x2, w.plan.x2, 1);
  save(memory.u, w.plan.u, 1);
  w.rows.each([&](const auto& row, int index) {
    save(memory.force[static_cast<std::size_t>(index)], row.y, row.rho);
  });
  return memory;
}

/// The reverse.
template <std::size_t rows, class Problem>
void recall(workspace<Problem>& w, const warm_start<rows>& memory) noexcept {
  const auto n = w.n = memory.steps;
  const auto load = [n](column& to, const auto& from) {
    std::copy_n(from.begin(), n + 1, to.begin());
  };
  load(w.plan.x0, memory.x0);
  load(w.plan.x1, memory.x1);
  load(w.plan.x2, memory.x2);
  load(w.plan.u, memory.u);
  w.rows.each([&](auto& row, int index) {
    load(row.y, memory.force[static_cast<std::size_t>(index)]);
    row.rho = 1;
  });
}

} // namespace sofof::ocp
