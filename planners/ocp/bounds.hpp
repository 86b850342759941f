// Bounds in the augmented Lagrangian: what sticks out of them, their
// multipliers, and how far a plan breaks them. See `row`.
#pragma once

#include "planners/ocp/status.hpp"
#include "planners/ocp/workspace.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners::ocp {

/// @returns where lo > hi is worst; knot -1 where it is nowhere.
template <class Problem>
violation crossed_bounds(workspace<Problem>& w) noexcept {
  assert(w.is_sized());
  violation worst;
  w.rows.each([&](const auto& r, int index) {
    assert(r.tolerance > 0);
    double most = 0;
#pragma omp simd reduction(max : most)
    for (int k = 0; k < w.padded; ++k) {
      const double crossed = r.lo[k] - r.hi[k];
      most = crossed > most ? crossed : most;
    }
    if (most > worst.scaled * r.tolerance)
      for (int k = 0; k < w.padded; ++k)
        worst.keep_worse(r.lo[k] - r.hi[k], r.tolerance, index, k);
  });
  assert(worst.knot <= w.n); // neutral knots have no bounds
  return worst;
}

/// Finds what sticks out of the bounds.
/// @returns whether the same bounds are active as before.
template <class Problem>
bool stick_out(workspace<Problem>& w) noexcept {
  const auto m = w.padded;
  assert(w.is_sized());
  double change = 0;
  w.rows.each([&](auto& r, int) {
    const double rho = r.rho;
    assert(rho > 0 && std::isfinite(rho));
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (int k = 0; k < m; ++k) {
      const double v = beyond(r.c[k] + r.y[k], r.lo[k], r.hi[k]);
      const double active = v != 0 ? rho : 0;
      sum += std::abs(active - r.active[k]);
      r.v[k] = v;
      r.active[k] = active;
    }
    change += sum;
  });
  return change == 0;
}

/// Sets the multipliers to what sticks out, and raises the penalty of a row
/// whose multipliers change slowly. What sticks out is to be found anew.
/// @returns the largest change of a multiplier over its penalty, in
/// tolerances: violation and complementarity in one.
template <class Problem>
double update_multipliers(workspace<Problem>& w,
                          const solver_options& options) noexcept {
  const auto m = w.padded;
  assert(w.is_sized() && options.firmer > 1);
  double worst = 0;
  w.rows.each([&](auto& r, int) {
    assert(r.tolerance > 0);
    double largest = 0;
#pragma omp simd reduction(max : largest)
    for (int k = 0; k < m; ++k) {
      const double change = std::abs(r.v[k] - r.y[k]);
      largest = change > largest ? change : largest;
      r.y[k] = r.v[k];
    }
    largest /= r.tolerance;
    worst = std::max(worst, largest);
    // Neighbours that exchange their multipliers do it slowly.
    const auto slow = largest > 1 && largest > options.slow * r.last_change;
    if (slow && r.rho < options.firmest * r.least_rho) {
      for (int k = 0; k < m; ++k)
        r.y[k] /= options.firmer;
      r.rho *= options.firmer;
    }
    assert(r.rho >= r.least_rho); // it only grows
    r.last_change = largest;
  });
  assert(worst >= 0);
  return worst;
}

/// Enters into a report how far the rows' values are beyond their bounds.
template <class Problem>
void measure_violation(const workspace<Problem>& w,
                       solve_report& report) noexcept {
  const auto m = w.padded;
  report.violation = 0;
  report.worst = {};
  w.rows.each([&](const auto& r, int index) {
    assert(r.tolerance > 0);
    const auto out = [&r](int k) {
      return std::abs(beyond(r.c[k], r.lo[k], r.hi[k]));
    };
    double most = 0;
#pragma omp simd reduction(max : most)
    for (int k = 0; k < m; ++k) {
      const double here = out(k);
      most = here > most ? here : most;
    }
    report.violation = std::max(report.violation, most);
    if (most > report.worst.scaled * r.tolerance)
      for (int k = 0; k < m; ++k)
        report.worst.keep_worse(out(k), r.tolerance, index, k);
  });
  assert(report.violation >= report.worst.amount);
}

} // namespace sofof::planners::ocp
