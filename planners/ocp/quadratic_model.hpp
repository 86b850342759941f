// The quadratic model of cost and bounds around the iterate, and the step
// along a direction to where it is least.
#pragma once

#include "planners/ocp/workspace.hpp"

#include <cassert>
#include <cmath>

namespace sofof::planners::ocp {

/// Slope of the cost along a direction, and how it changes.
struct cost_along {
  double slope = 0, bend = 0;
};

/// Gradient of cost and bounds.
template <class Problem>
void expand_slope(workspace<Problem>& w) noexcept {
  assert(w.is_sized());
  const auto m = w.padded;
  const auto& slope = w.slope;
  auto& g = w.g;
  for (int k = 0; k < m; ++k) {
    g.x0[k] = slope.x0[k];
    g.x1[k] = slope.x1[k];
    g.x2[k] = slope.x2[k];
    g.u[k] = slope.u[k];
  }
  w.rows.each([m, &g](const auto& r, int) {
    for (int k = 0; k < m; ++k) {
      const double force = r.rho * r.v[k];
      assert((r.v[k] != 0) == (r.active[k] != 0)); // found by stick_out
      gather(g.x0[k], force * r.g0[k]);
      gather(g.x1[k], force * r.g1[k]);
      gather(g.x2[k], force * r.g2[k]);
      gather(g.u[k], force * r.gu[k]);
    }
  });
}

/// Hessian of cost and active bounds.
template <class Problem>
void expand_bend(workspace<Problem>& w) noexcept {
  assert(w.is_sized());
  const auto m = w.padded;
  const auto& cost = w.cost;
  auto& h = w.h;
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
  w.rows.each([m, &h](const auto& r, int) {
    for (int k = 0; k < m; ++k) {
      const double rho = r.active[k];
      assert(rho == 0 || rho == r.rho);
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
cost_along measure_direction(workspace<Problem>& w) noexcept {
  const auto m = w.padded;
  const auto& e = w.direction;
  const auto& c = w.cost;
  const auto& g = w.slope;
  assert(w.is_sized());
  assert(e.x0[0] == 0 && e.x1[0] == 0 && e.x2[0] == 0); // the start stays
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
  w.rows.each([m, &e](auto& r, int) {
    for (int k = 0; k < m; ++k)
      r.dc[k] = value(r.g0[k] * e.x0[k] + r.g1[k] * e.x1[k] + r.g2[k] * e.x2[k]
                      + r.gu[k] * e.u[k]);
  });
  return {slope, bend};
}

/// Slope of cost and bounds when the share `alpha` of the way is gone.
template <class Problem>
double slope_at(const workspace<Problem>& w, const cost_along& cost,
                double alpha) noexcept {
  assert(w.is_sized());
  assert(!(alpha < 0 || alpha > 1 + 1e-9));
  const auto m = w.padded;
  double slope = cost.slope + alpha * cost.bend;
  w.rows.each([&](const auto& r, int) {
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

/// @returns where along the direction the model is least, within `longest`:
/// the zero of its slope, which is piecewise linear and grows.
template <class Problem>
double best_step(const workspace<Problem>& w, const cost_along& cost,
                 double longest, double decrement) noexcept {
  constexpr auto enough = 0.1; // of the slope at the start
  constexpr auto most_trials = 8;
  assert(decrement >= 0 && !(longest < 0 || longest > 1));
  double a = 0, low = -decrement;
  double b = longest, high = slope_at(w, cost, b);
  if (high <= enough * decrement)
    return longest;
  // Illinois: a secant that halves the slope of an end that stays.
  double alpha = b;
  for (int trial = 0; trial < most_trials; ++trial) {
    assert(!(low > 0 || high < 0)); // the zero lies between a and b
    alpha = (a * high - b * low) / (high - low);
    const auto slope = slope_at(w, cost, alpha);
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

/// Goes the share `alpha` of the way.
template <class Problem>
void step_along(workspace<Problem>& w, double alpha) noexcept {
  assert(w.is_sized());
  assert(!(alpha < 0 || alpha > 1 + 1e-9));
  const auto m = w.padded;
  const auto& c = w.cost;
  const auto& e = w.direction;
  auto& x = w.iterate;
  auto& g = w.slope;
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
  w.rows.each([=](auto& r, int) {
    for (int k = 0; k < m; ++k)
      r.c[k] += alpha * r.dc[k];
  });
}

} // namespace sofof::planners::ocp
