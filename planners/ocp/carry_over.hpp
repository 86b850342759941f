// A plan and its multipliers on a grid, carried over to another: because the
// vehicle drives on, or its horizon shrinks.
#pragma once

#include "planners/ocp/workspace.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

namespace sofof::planners::ocp {

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
    assert(by_m >= 0 && old_ds_m > 0 && ds_m > 0);
    assert(old_steps >= 1 && old_steps <= most_steps);
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

/// @returns whether a plan can be carried over to this grid.
inline bool can_move(double by_m, double ds_m, int steps) {
  return steps >= 1 && steps <= most_steps && ds_m > 0 && std::isfinite(ds_m)
         && by_m >= 0 && std::isfinite(by_m);
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
  assert(g.first >= 0 && g.step > 0);
  assert(g.last >= 1 && g.last <= most_steps);
  assert(g.last_of_new >= 1 && g.last_of_new <= most_steps);
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
    assert(i >= 0 && at >= i);
    c[k] = scale * ((1 - (at - i)) * old[i] + (at - i) * old[i + 1]);
  }
  for (; k <= g.last_of_new; ++k)
    c[k] = tail;
}

/// Multipliers grow with the length of their stage.
/// @param on_steps  The row whose bounds belong to steps, not to knots.
template <class Rows>
void resample_multipliers(Rows& rows, const regrid& g, int on_steps) {
  const auto knots = static_cast<std::size_t>(g.last) + 1;
  rows.each([&](auto& row, int index) {
    // Most bounds hold nothing back.
    if (std::ranges::count(std::span{row.y}.first(knots), 0.0)
        == static_cast<std::ptrdiff_t>(knots)) {
      std::fill_n(row.y.begin(), g.last_of_new + 1, 0.0);
      return;
    }
    resample(row.y, index == on_steps ? g.of_steps() : g, g.step, 0);
  });
}

} // namespace sofof::planners::ocp
