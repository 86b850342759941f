// Whether a plan is optimal, judged without the solver's own derivatives.
#pragma once

#include "planners/problems/path_ocp.hpp"
#include "planners/problems/velocity_ocp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace sofof::test {

/// What is left of the conditions of Karush, Kuhn and Tucker at a plan.
struct kkt {
  /// What a Newton step could still win, as a share of the cost.
  double decrease = 0;
  /// Largest multiplier of a bound that is not met, over the penalty, in
  /// tolerances.
  double complementarity = 0;
};

/// @param step  (x, u, k) -> next x, for complex numbers.
/// @param lagrangian  (x, u, k) -> what knot k adds to the cost plus
///                    multipliers times rows, for complex numbers.
template <class Workspace, class Step, class Lagrangian>
kkt kkt_of(const Workspace& w, double cost, Step step, Lagrangian lagrangian) {
  using complex = std::complex<double>;
  constexpr auto tiny = 1e-30;
  const auto& x = w.plan;
  std::array<double, 3> costate{};
  kkt left;
  for (int k = w.n; k >= 0; --k) {
    std::array<double, 4> slope{};
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<complex, 4> z{x.x0[k], x.x1[k], x.x2[k], x.u[k]};
      z[i] += complex{0, tiny};
      const std::array<complex, 3> state{z[0], z[1], z[2]};
      slope[i] = lagrangian(state, z[3], k).imag() / tiny;
      if (k == w.n)
        continue;
      const auto next = step(state, z[3], k);
      for (std::size_t j = 0; j < 3; ++j)
        slope[i] += costate[j] * next[j].imag() / tiny;
    }
    std::copy_n(slope.begin(), 3, costate.begin());
    if (k == w.n)
      continue;
    // Where the slope in u is zero everywhere, the feedback does not matter;
    // with it, a slope here counts as what it costs when all that follows
    // reacts to it.
    left.decrease += slope[3] * slope[3] * w.inverse[k] / 2 / cost;
    costate[0] += w.k0[k] * slope[3];
    costate[1] += w.k1[k] * slope[3];
    costate[2] += w.k2[k] * slope[3];
  }
  w.rows.each([&](const auto& r, int) {
    for (int k = 0; k <= w.n; ++k) {
      const auto slack = r.y[k] > 0 ? r.hi[k] - r.c[k] : r.c[k] - r.lo[k];
      const auto idle = std::min(std::abs(slack), std::abs(r.y[k]));
      left.complementarity = std::max(left.complementarity, idle / r.tolerance);
    }
  });
  return left;
}

inline kkt kkt_of(const planners::path_ocp& solved,
                  const planners::path_problem& p, double cost) {
  const auto& w = solved.inside();
  const auto number = [](int k) { return static_cast<std::size_t>(k); };
  const auto step = [&](const auto& x, auto u, int k) {
    return planners::ocp::path_step(x, u, p.curvature_1pm[number(2 * k)],
                                    p.curvature_1pm[number(2 * k + 1)], p.ds_m);
  };
  const auto lagrangian = [&](const auto& x, auto u, int k) {
    const auto& q = p.weights;
    const auto off = x[0] - p.wanted_m[number(k)];
    auto sum = (k < p.steps ? p.ds_m : q.end_factor)
               * (q.offset * off * off + q.heading * x[1] * x[1]
                  + q.curvature * x[2] * x[2]);
    if (k < p.steps)
      sum += p.ds_m * q.rate * u * u;
    for (std::size_t j = 0; j < p.discs.size(); ++j) {
      const auto& row = w.rows.disc[j];
      sum += row.rho * row.y[k] * (x[0] + p.discs[j].ahead_m * std::sin(x[1]));
    }
    sum += w.rows.curvature.rho * w.rows.curvature.y[k] * x[2];
    return sum + w.rows.rate.rho * w.rows.rate.y[k] * u;
  };
  return kkt_of(w, cost, step, lagrangian);
}

inline kkt kkt_of(const planners::velocity_ocp& solved,
                  const planners::velocity_problem& p, double cost) {
  const auto& w = solved.inside();
  // Without max(w, 0): at rest the slopes count that point to driving.
  const auto speed = [](auto w2) {
    return std::sqrt(2. * w2
                     + planners::ocp::crawl_mps * planners::ocp::crawl_mps);
  };
  const auto step = [&](const auto& x, auto u, int) {
    auto next = planners::ocp::velocity_step(x, u, p.ds_m);
    next[0] = x[0] + 2 * p.ds_m / (speed(x[1]) + speed(next[1]));
    return next;
  };
  const auto lagrangian = [&](const auto& x, auto u, int k) {
    const auto& q = p.weights;
    const auto& rows = w.rows;
    const auto at = static_cast<std::size_t>(k);
    const auto wanted = p.wanted_m2ps2[at];
    const auto off = x[1] - wanted;
    const auto jerk = u * speed(x[1]);
    auto sum = (k < p.steps ? p.ds_m : q.end_m)
               * (q.speed / (2 * wanted) * off * off + q.accel * x[2] * x[2]);
    if (k < p.steps)
      sum += p.ds_m * q.jerk * jerk * jerk;
    const auto across = 2 * p.curvature_1pm[at] * x[1];
    const auto total = std::sqrt(x[2] * x[2] + across * across + 1e-12);
    return sum + rows.time.rho * rows.time.y[k] * x[0]
           + rows.speed.rho * rows.speed.y[k] * x[1]
           + rows.accel.rho * rows.accel.y[k] * x[2]
           + rows.total.rho * rows.total.y[k] * total
           + rows.jerk.rho * rows.jerk.y[k] * jerk;
  };
  return kkt_of(w, cost, step, lagrangian);
}

} // namespace sofof::test
