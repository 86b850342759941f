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

#include "planners/ocp/riccati.hpp"
#include "planners/ocp/status.hpp"

#include <algorithm>
#include <cmath>

namespace sofof::ocp {

/// @returns where lo > hi is worst; knot -1 where it is nowhere.
template <class Problem>
violation crossed_bounds(workspace<Problem>& w) noexcept {
  violation worst;
  w.rows.each([&](const auto& r, int index) {
    double most = 0;
#pragma omp simd reduction(max : most)
    for (int k = 0; k < w.padded; ++k) {
      const double crossed = r.lo[k] - r.hi[k];
      most = crossed > most ? crossed : most;
    }
    if (most > worst.scaled * r.tolerance)
      for (int k = 0; k < w.padded; ++k)
        worst.see(r.lo[k] - r.hi[k], r.tolerance, index, k);
  });
  return worst;
}

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

  /// `optimal`: the plan was already; `stuck`: the model has no plan within
  /// its bounds; `partial`: only as far as the model holds.
  enum class ended { optimal, settled, stuck, partial, interrupted, broken };

  void begin() noexcept;
  double join() noexcept;
  ended newton(const budget& go_on) noexcept;
  double find_direction(bool gaps) noexcept;
  bool is_optimal() noexcept;
  void expand_slope() noexcept;
  void expand_bend() noexcept;
  void measure_direction() noexcept;
  double best_step(double longest, double decrement) const noexcept;
  double slope_at(double alpha) const noexcept;
  bool move(double alpha) noexcept;
  bool stick_out() noexcept;
  double update_multipliers() noexcept;
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
  double cost_slope_ = 0;    ///< Of the cost along the direction ...
  double cost_bend_ = 0;     ///< ... and how it changes.
};

template <class Problem>
solve_report ms_al<Problem>::solve(const budget& go_on) noexcept {
  constexpr auto no_gap = 1e-9;
  constexpr auto near = 10.; // the linear model's error, in what is allowed
  begin();
  for (;;) {
    problem_.linearise(w_);
    ++report_.linearisations;
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
  for (auto* x : {&w_.plan, &w_.direction}) {
    for (int k = n + 1; k < m; ++k)
      x->x0[k] = x->x1[k] = x->x2[k] = 0;
    for (int k = n; k < m; ++k)
      x->u[k] = 0;
  }
  adopt();
  w_.rows.each([m](auto& r, int) {
    for (int k = 0; k < m; ++k)
      r.y[k] = r.lo[k] > -no_bound || r.hi[k] < no_bound ? r.y[k] : 0;
  });
}

/// Turns the states after each step into the gaps.
/// @returns the largest.
template <class Problem>
double ms_al<Problem>::join() noexcept {
  const auto n = w_.n;
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
  same_active_ = stick_out();
  if (candidate_ && joined_ && same_active_ && is_optimal())
    return ended::optimal;
  same_active_ = false;
  w_.rows.each([](auto& r, int) { r.last_change = no_bound; });
  double last_change = no_bound;
  int standstill = 0;
  for (int inner = 0; inner < options_.max_inner; ++inner) {
    if (report_.iterations >= options_.max_iterations
        || !go_on(report_.iterations))
      return ended::interrupted;
    ++report_.iterations;
    const auto gaps = inner == 0 && !joined_;
    const auto decrement = find_direction(gaps);
    if (!(decrement >= 0))
      return ended::broken;
    measure_direction();
    const auto longest = inner == 0 ? problem_.longest_step(w_) : 1.;
    // With gaps to close, the cost's slope does not say where to stop.
    const auto alpha = gaps ? longest : best_step(longest, decrement);
    same_active_ = move(alpha);
    if (longest < 1)
      return ended::partial;
    const auto flat = !gaps && decrement < options_.decrement;
    const auto minimal = flat || (same_active_ && alpha == 1);
    if (!minimal)
      continue;
    const auto change = update_multipliers();
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
  expand_slope();
  return resolve(w_) <= options_.decrement + options_.optimality * report_.cost;
}

/// @returns the decrement; negative or NaN when there is none.
template <class Problem>
double ms_al<Problem>::find_direction(bool gaps) noexcept {
  expand_slope();
  if (!same_active_)
    expand_bend();
  if (gaps) {
    const auto decrement = factorise<true>(w_);
    sweep_forward<true>(w_);
    return decrement;
  }
  const auto decrement = same_active_ ? resolve(w_) : factorise<false>(w_);
  sweep_forward<false>(w_);
  return decrement;
}

/// Gradient of cost and bounds.
template <class Problem>
void ms_al<Problem>::expand_slope() noexcept {
  const auto m = w_.padded;
  const auto& slope = w_.slope;
  auto& g = w_.g;
  for (int k = 0; k < m; ++k) {
    g.x0[k] = slope.x0[k];
    g.x1[k] = slope.x1[k];
    g.x2[k] = slope.x2[k];
    g.u[k] = slope.u[k];
  }
  w_.rows.each([m, &g](const auto& r, int) {
    for (int k = 0; k < m; ++k) {
      const double force = r.rho * r.v[k];
      gather(g.x0[k], force * r.g0[k]);
      gather(g.x1[k], force * r.g1[k]);
      gather(g.x2[k], force * r.g2[k]);
      gather(g.u[k], force * r.gu[k]);
    }
  });
}

/// Hessian of cost and active bounds.
template <class Problem>
void ms_al<Problem>::expand_bend() noexcept {
  const auto m = w_.padded;
  const auto& cost = w_.cost;
  auto& h = w_.h;
  for (int k = 0; k < m; ++k) {
    put(h.h00, k, cost.h00[k]);
    put(h.h01, k, cost.h01[k]);
    put(h.h02, k, cost.h02[k]);
    put(h.h11, k, cost.h11[k]);
    put(h.h12, k, cost.h12[k]);
    put(h.h22, k, cost.h22[k]);
    put(h.s0, k, cost.s0[k]);
    put(h.s1, k, cost.s1[k]);
    put(h.s2, k, cost.s2[k]);
    put(h.r, k, cost.r[k]);
  }
  w_.rows.each([m, &h](const auto& r, int) {
    for (int k = 0; k < m; ++k) {
      const double rho = r.active[k];
      const auto r0 = rho * r.g0[k];
      const auto r1 = rho * r.g1[k];
      const auto r2 = rho * r.g2[k];
      const auto ru = rho * r.gu[k];
      add(h.h00, k, r0 * r.g0[k]);
      add(h.h01, k, r0 * r.g1[k]);
      add(h.h02, k, r0 * r.g2[k]);
      add(h.h11, k, r1 * r.g1[k]);
      add(h.h12, k, r1 * r.g2[k]);
      add(h.h22, k, r2 * r.g2[k]);
      add(h.s0, k, r0 * r.gu[k]);
      add(h.s1, k, r1 * r.gu[k]);
      add(h.s2, k, r2 * r.gu[k]);
      add(h.r, k, ru * r.gu[k]);
    }
  });
}

/// What cost and rows do along the direction.
template <class Problem>
void ms_al<Problem>::measure_direction() noexcept {
  const auto m = w_.padded;
  const auto& e = w_.direction;
  const auto& c = w_.cost;
  const auto& g = w_.slope;
  double slope = 0, bend = 0;
#pragma omp simd reduction(+ : slope, bend)
  for (int k = 0; k < m; ++k) {
    const double e0 = e.x0[k], e1 = e.x1[k], e2 = e.x2[k], eu = e.u[k];
    slope += g.x0[k] * e0 + g.x1[k] * e1 + g.x2[k] * e2 + g.u[k] * eu;
    bend += value(c.h00[k] * (e0 * e0) + c.h11[k] * (e1 * e1)
                  + c.h22[k] * (e2 * e2) + c.r[k] * (eu * eu))
            + 2
                  * value(c.h01[k] * (e0 * e1) + c.h02[k] * (e0 * e2)
                          + c.h12[k] * (e1 * e2)
                          + (c.s0[k] * e0 + c.s1[k] * e1 + c.s2[k] * e2) * eu);
  }
  cost_slope_ = slope;
  cost_bend_ = bend;
  w_.rows.each([m, &e](auto& r, int) {
    for (int k = 0; k < m; ++k)
      r.dc[k] = value(r.g0[k] * e.x0[k] + r.g1[k] * e.x1[k] + r.g2[k] * e.x2[k]
                      + r.gu[k] * e.u[k]);
  });
}

/// @returns where along the direction the model is least, within `longest`:
/// the zero of its slope, which is piecewise linear and grows.
template <class Problem>
double ms_al<Problem>::best_step(double longest,
                                 double decrement) const noexcept {
  constexpr auto enough = 0.1; // of the slope at the start
  constexpr auto most_trials = 8;
  double a = 0, low = -decrement;
  double b = longest, high = slope_at(b);
  if (high <= enough * decrement)
    return longest;
  // Illinois: a secant that halves the slope of an end that stays.
  double alpha = b;
  for (int trial = 0; trial < most_trials; ++trial) {
    alpha = (a * high - b * low) / (high - low);
    const auto slope = slope_at(alpha);
    if (std::abs(slope) <= enough * decrement)
      break;
    if (slope > 0) {
      b = alpha, high = slope;
      low /= 2;
    } else {
      a = alpha, low = slope;
      high /= 2;
    }
  }
  return alpha;
}

/// Slope of cost and bounds when the share `alpha` of the way is gone.
template <class Problem>
double ms_al<Problem>::slope_at(double alpha) const noexcept {
  const auto m = w_.padded;
  double slope = cost_slope_ + alpha * cost_bend_;
  w_.rows.each([&](const auto& r, int) {
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (int k = 0; k < m; ++k) {
      const double t = r.c[k] + r.y[k] + alpha * r.dc[k];
      sum += r.dc[k] * beyond(t, r.lo[k], r.hi[k]);
    }
    slope += r.rho * sum;
  });
  return slope;
}

/// Goes the share `alpha` of the way.
/// @returns whether the same bounds are active as before.
template <class Problem>
bool ms_al<Problem>::move(double alpha) noexcept {
  const auto m = w_.padded;
  const auto& c = w_.cost;
  const auto& e = w_.direction;
  auto& x = w_.iterate;
  auto& g = w_.slope;
  for (int k = 0; k < m; ++k) {
    const double e0 = alpha * e.x0[k], e1 = alpha * e.x1[k];
    const double e2 = alpha * e.x2[k], eu = alpha * e.u[k];
    x.x0[k] += e0;
    x.x1[k] += e1;
    x.x2[k] += e2;
    x.u[k] += eu;
    gather(g.x0[k],
           c.h00[k] * e0 + c.h01[k] * e1 + c.h02[k] * e2 + c.s0[k] * eu);
    gather(g.x1[k],
           c.h01[k] * e0 + c.h11[k] * e1 + c.h12[k] * e2 + c.s1[k] * eu);
    gather(g.x2[k],
           c.h02[k] * e0 + c.h12[k] * e1 + c.h22[k] * e2 + c.s2[k] * eu);
    gather(g.u[k], c.s0[k] * e0 + c.s1[k] * e1 + c.s2[k] * e2 + c.r[k] * eu);
  }
  w_.rows.each([=](auto& r, int) {
    for (int k = 0; k < m; ++k)
      r.c[k] += alpha * r.dc[k];
  });
  return stick_out();
}

/// Finds what sticks out of the bounds.
/// @returns whether the same bounds are active as before.
template <class Problem>
bool ms_al<Problem>::stick_out() noexcept {
  const auto m = w_.padded;
  double change = 0;
  w_.rows.each([&](auto& r, int) {
    const double rho = r.rho;
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

/// @returns the largest change of a multiplier over its penalty, in
/// tolerances: violation and complementarity in one.
template <class Problem>
double ms_al<Problem>::update_multipliers() noexcept {
  const auto m = w_.padded;
  double worst = 0;
  w_.rows.each([&](auto& r, int) {
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
    const auto slow = largest > 1 && largest > options_.slow * r.last_change;
    if (slow && r.rho < options_.firmest * r.least_rho) {
      for (int k = 0; k < m; ++k)
        r.y[k] /= options_.firmer;
      r.rho *= options_.firmer;
    }
    r.last_change = largest;
  });
  same_active_ = stick_out() && same_active_;
  return worst;
}

/// Rolls the plan out, and measures it.
/// @returns how far it left the model's, in what may be.
template <class Problem>
double ms_al<Problem>::publish() noexcept {
  const auto m = w_.padded;
  const auto left = problem_.roll_out(w_);
  report_.cost = problem_.evaluate(w_);
  report_.violation = 0;
  report_.worst = {};
  w_.rows.each([&](const auto& r, int index) {
    const auto out = [&r](int k) {
      return std::abs(beyond(r.c[k], r.lo[k], r.hi[k]));
    };
    double most = 0;
#pragma omp simd reduction(max : most)
    for (int k = 0; k < m; ++k) {
      const double here = out(k);
      most = here > most ? here : most;
    }
    report_.violation = std::max(report_.violation, most);
    if (most > report_.worst.scaled * r.tolerance)
      for (int k = 0; k < m; ++k)
        report_.worst.see(out(k), r.tolerance, index, k);
  });
  return left;
}

} // namespace sofof::ocp
