// The optimal-control solver: multiple shooting, an augmented Lagrangian for
// the bounds, Newton steps by Riccati sweeps, exact piecewise line search.
//
// A problem is a class without virtual functions: three states, one control.
// It says which coefficients vary (dynamics, cost_hessian, hessian: patterns;
// row_set: its rows) and fills them:
//   linearise(w)  model, cost and rows at w.iterate; in gap0..gap2 the states
//                 after each step
//   roll_out(w)   w.plan by the true dynamics from the iterate's first state,
//                 following the iterate with the feedback; returns how far
//                 it left, over what the linear model may be wrong by
//   evaluate(w)   the rows' values c at w.plan; returns the cost, infinity
//                 where the true dynamics do not hold
//   longest_step(w)  share of w.direction for which the model holds, in (0, 1]
// Only for the sources that solve a problem: its loops need -fopenmp-simd.
#pragma once

#include "planners/ocp/bounds.hpp"
#include "planners/ocp/quadratic_model.hpp"
#include "planners/ocp/riccati.hpp"
#include "planners/ocp/status.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners::ocp {

template <class Problem>
class ms_al {
public:
  ms_al(const Problem& problem, workspace<Problem>& w,
        const solver_options& options)
      : problem_{problem}, w_{w}, options_{options} {}

  /// Starts from the plan and multipliers in the workspace; leaves there the
  /// published plan and its multipliers.
  solve_report solve(const budget& go_on) noexcept;

private:
  static constexpr auto nearly = 10.; ///< Tolerances that are acceptable.
  static constexpr auto rounding = 1e-9;

  /// `optimal`: the plan was already; `stuck`: the model has no plan within
  /// its bounds; `partial`: only as far as the model holds.
  enum class ended { optimal, settled, stuck, partial, interrupted, broken };

  void begin() noexcept;
  double join() noexcept;
  ended newton(const budget& go_on) noexcept;
  double find_direction(bool gaps) noexcept;
  bool is_optimal() noexcept;
  double publish() noexcept;
  solve_status verdict(ended how) const noexcept;
  void adopt() noexcept;

  const Problem& problem_;
  workspace<Problem>& w_;
  const solver_options& options_;
  solve_report report_;
  bool candidate_ = false;   ///< The plan may be optimal.
  bool stuck_ = false;       ///< The last model had no plan.
  bool joined_ = false;      ///< The iterate has no gaps.
  bool same_active_ = false; ///< The factorisation still holds.
};

template <class Problem>
solve_report ms_al<Problem>::solve(const budget& go_on) noexcept {
  constexpr auto no_gap = 1e-9;
  constexpr auto near = 10.; // the linear model's error, in what is allowed
  assert(options_.max_inner >= 1 && options_.decrement >= 0);
  begin();
  for (;;) {
    problem_.linearise(w_);
    ++report_.linearisations;
    assert(report_.linearisations <= std::max(1, options_.max_linearisations));
    joined_ = join() < no_gap;
    const auto how = newton(go_on);
    if (how == ended::optimal) {
      report_.status = solve_status::converged;
      return report_;
    }
    // Linearised where it is stuck, the model is to confirm it.
    const auto hopeless = how == ended::stuck && stuck_;
    const auto last = how == ended::interrupted || how == ended::broken
                      || hopeless
                      || report_.linearisations >= options_.max_linearisations;
    stuck_ = how == ended::stuck;
    if (how == ended::partial && !last)
      continue;
    const auto left = publish();
    if (last) {
      report_.status = verdict(how);
      return report_;
    }
    candidate_ = how == ended::settled && left <= 1 && report_.worst.scaled <= 1
                 && std::isfinite(report_.cost);
    if (left <= near)
      adopt();
  }
}

/// What to say about a plan that is not known to be optimal.
template <class Problem>
solve_status ms_al<Problem>::verdict(ended how) const noexcept {
  using enum solve_status;
  assert(how != ended::optimal && report_.worst.scaled >= 0);
  assert(report_.iterations <= options_.max_iterations);
  if (how == ended::broken || std::isnan(report_.cost))
    return numerical;
  if (report_.worst.scaled <= nearly && std::isfinite(report_.cost))
    return acceptable;
  const auto spent = how == ended::stuck
                     || report_.iterations >= options_.max_iterations
                     || report_.linearisations >= options_.max_linearisations;
  return spent ? soft_infeasible : budget;
}

/// Goes on from the plan.
template <class Problem>
void ms_al<Problem>::adopt() noexcept {
  const auto m = w_.padded;
  for (int k = 0; k < m; ++k) {
    w_.iterate.x0[k] = w_.plan.x0[k];
    w_.iterate.x1[k] = w_.plan.x1[k];
    w_.iterate.x2[k] = w_.plan.x2[k];
    w_.iterate.u[k] = w_.plan.u[k];
  }
}

/// Makes the knots neutral that are none, or have no bounds.
template <class Problem>
void ms_al<Problem>::begin() noexcept {
  const auto m = w_.padded, n = w_.n;
  assert(w_.is_sized());
  for (auto* x : {&w_.plan, &w_.direction}) {
    for (int k = n + 1; k < m; ++k)
      x->x0[k] = x->x1[k] = x->x2[k] = 0;
    for (int k = n; k < m; ++k)
      x->u[k] = 0;
  }
  for (auto* feedback : {&w_.k0, &w_.k1, &w_.k2})
    std::fill_n(feedback->begin(), m, 0.0); // of no step yet
  adopt();
  w_.rows.each([m](auto& r, int) {
    assert(r.rho > 0 && r.tolerance > 0);
    for (int k = 0; k < m; ++k)
      r.y[k] = r.lo[k] > -no_bound || r.hi[k] < no_bound ? r.y[k] : 0;
  });
}

/// Turns the states after each step into the gaps.
/// @returns the largest.
template <class Problem>
double ms_al<Problem>::join() noexcept {
  const auto n = w_.n;
  assert(w_.is_sized());
  double largest = 0;
  const auto close = [n, &largest](column& gap, const column& x) {
    double most = 0;
#pragma omp simd reduction(max : most)
    for (int k = 0; k < n; ++k) {
      const double d = gap[k] - x[k + 1];
      gap[k] = d;
      const double size = std::abs(d);
      most = size > most ? size : most;
    }
    largest = std::max(largest, most);
  };
  close(w_.gap0, w_.iterate.x0);
  close(w_.gap1, w_.iterate.x1);
  close(w_.gap2, w_.iterate.x2);
  return largest;
}

/// Solves the linear-quadratic model with its bounds.
template <class Problem>
auto ms_al<Problem>::newton(const budget& go_on) noexcept -> ended {
  same_active_ = stick_out(w_);
  if (candidate_ && joined_ && same_active_ && is_optimal())
    return ended::optimal;
  same_active_ = false;
  w_.rows.each([](auto& r, int) { r.last_change = no_bound; });
  double last_change = no_bound;
  int standstill = 0;
  assert(options_.patience >= 1);
  for (int inner = 0; inner < options_.max_inner; ++inner) {
    if (report_.iterations >= options_.max_iterations
        || !go_on(report_.iterations))
      return ended::interrupted;
    ++report_.iterations;
    const auto gaps = inner == 0 && !joined_;
    const auto decrement = find_direction(gaps);
    if (!(decrement >= 0))
      return ended::broken;
    const auto cost = measure_direction(w_);
    const auto longest = inner == 0 ? problem_.longest_step(w_) : 1.;
    // With gaps to close, the cost's slope does not say where to stop.
    const auto alpha = gaps ? longest : best_step(w_, cost, longest, decrement);
    assert(!(longest < 0 || longest > 1));
    assert(!(alpha < 0 || alpha > longest + rounding));
    step_along(w_, alpha);
    same_active_ = stick_out(w_);
    if (longest < 1)
      return ended::partial;
    const auto flat = !gaps && decrement < options_.decrement;
    const auto minimal = flat || (same_active_ && alpha == 1);
    if (!minimal)
      continue;
    const auto change = update_multipliers(w_, options_);
    same_active_ = stick_out(w_) && same_active_;
    if (change <= 1)
      return ended::settled;
    // Multipliers that grow and grow: what is left is the least violation.
    const auto stands =
        change > nearly && change > options_.standstill * last_change;
    standstill = stands ? standstill + 1 : 0;
    last_change = change;
    if (standstill >= options_.patience)
      return ended::stuck;
  }
  return ended::settled;
}

/// The plan is where the model was least, with the same active bounds; is it
/// where the true problem is? The last feedback is good enough to tell.
template <class Problem>
bool ms_al<Problem>::is_optimal() noexcept {
  assert(joined_ && same_active_ && std::isfinite(report_.cost));
  expand_slope(w_);
  return resolve(w_) <= options_.decrement + options_.optimality * report_.cost;
}

/// @returns the decrement; negative or NaN when there is none.
template <class Problem>
double ms_al<Problem>::find_direction(bool gaps) noexcept {
  assert(w_.is_sized());
  assert(!(gaps && same_active_)); // `resolve` knows of none
  expand_slope(w_);
  if (!same_active_)
    expand_bend(w_);
  if (gaps) {
    const auto decrement = factorise<true>(w_);
    sweep_forward<true>(w_);
    return decrement;
  }
  const auto decrement = same_active_ ? resolve(w_) : factorise<false>(w_);
  sweep_forward<false>(w_);
  return decrement;
}

/// Rolls the plan out, and measures it.
/// @returns how far it left the model's, in what may be.
template <class Problem>
double ms_al<Problem>::publish() noexcept {
  const auto left = problem_.roll_out(w_);
  report_.cost = problem_.evaluate(w_);
  assert(!(left < 0) && !(report_.cost < 0));
  measure_violation(w_, report_);
  return left;
}

} // namespace sofof::planners::ocp
