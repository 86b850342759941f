// The path problem's model, in loops that become vector code.
#include "planners/problems/path_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::planners::ocp {

void path_model::linearise(workspace& w) const noexcept {
  const auto m = w.padded;
  const double half = ds / 2, h = ds;
  assert(w.is_sized() && ds > 0);
  assert(w.rows.discs >= 1 && w.rows.discs <= path_rows::most_discs);
  const auto& x = w.iterate;
  const auto& ref = reference;
  auto& a = w.model;
  auto& cosine = w.direction.x0; // scratch until there is a direction
  auto& sine = w.direction.x1;
  a.b2 = ds;
#pragma omp simd
  for (int k = 0; k < m; ++k) {
    const double d = x.x0[k], curvature = x.x2[k], u = x.u[k];
    const double r = ref.curvature[k], rm = ref.halfway[k];
    const auto at = sin_cos(x.x1[k]);
    sine[k] = at.sine;
    cosine[k] = at.cosine;
    // The slopes' derivatives at the knot, times half a step ...
    const double i = 1 / at.cosine, t = at.sine * i;
    const double q = 1 - d * r, qi = q * i;
    const double j00 = -half * r * t, j01 = half * qi * i;
    const double j10 = -half * r * curvature * i;
    const double j11 = half * qi * curvature * t, j12 = half * qi;
    // ... and in the middle, times the step.
    const double dm = d + half * (q * t);
    const double heading = x.x1[k] + half * (qi * curvature - r);
    const double cm = curvature + half * u;
    const auto mid = sin_cos(heading);
    const double im = 1 / mid.cosine, tm = mid.sine * im;
    const double qm = 1 - dm * rm, qim = qm * im;
    const double k00 = -h * rm * tm, k01 = h * qim * im;
    const double k10 = -h * rm * cm * im, k11 = h * qim * cm * tm;
    const double k12 = h * qim;
    a.a00[k] = 1 + k00 * (1 + j00) + k01 * j10;
    a.a01[k] = k00 * j01 + k01 * (1 + j11);
    a.a02[k] = k01 * j12;
    a.a10[k] = k10 * (1 + j00) + k11 * j10;
    a.a11[k] = 1 + k10 * j01 + k11 * (1 + j11);
    a.a12[k] = k11 * j12 + k12;
    a.b1[k] = half * k12;
    w.gap0[k] = d + h * (qm * tm);
    w.gap1[k] = x.x1[k] + h * (qim * cm - rm);
    w.gap2[k] = curvature + h * u;
  }
  for (int j = 0; j < w.rows.discs; ++j) {
    auto& row = w.rows.disc[static_cast<std::size_t>(j)];
    const double l = ahead[static_cast<std::size_t>(j)];
#pragma omp simd
    for (int k = 0; k < m; ++k) {
      row.c[k] = x.x0[k] + l * sine[k];
      row.g1[k] = l * cosine[k];
    }
  }
#pragma omp simd
  for (int k = 0; k < m; ++k) {
    w.rows.curvature.c[k] = x.x2[k];
    w.rows.rate.c[k] = x.u[k];
    w.slope.x0[k] = w.cost.h00[k] * (x.x0[k] - ref.wanted[k]);
    w.slope.x1[k] = w.cost.h11[k] * x.x1[k];
    w.slope.x2[k] = w.cost.h22[k] * x.x2[k];
    w.slope.u[k] = w.cost.r[k] * x.u[k];
  }
  for (int k = w.n + 1; k < m; ++k)
    cosine[k] = sine[k] = 0;
}

double path_model::roll_out(workspace& w) const noexcept {
  const auto& aim = w.iterate;
  const auto& bound = w.rows.rate;
  auto& plan = w.plan;
  std::array<double, 3> x{aim.x0[0], aim.x1[0], aim.x2[0]};
  double left = 0;
  assert(w.is_sized() && ds > 0 && model_error > 0);
  for (int k = 0; k < w.n; ++k) {
    plan.x0[k] = x[0];
    plan.x1[k] = x[1];
    plan.x2[k] = x[2];
    const double e0 = x[0] - aim.x0[k], e1 = x[1] - aim.x1[k];
    const double e2 = x[2] - aim.x2[k];
    left = std::max(left, std::abs(e0) + std::abs(e1));
    const double u = aim.u[k] + (w.k0[k] * e0 + w.k1[k] * e1 + w.k2[k] * e2);
    assert(bound.lo[k] <= bound.hi[k]);
    plan.u[k] = std::clamp(u, bound.lo[k], bound.hi[k]);
    x = path_step(x, plan.u[k], reference.curvature[k], reference.halfway[k],
                  ds);
  }
  const auto n = w.n;
  plan.x0[n] = x[0];
  plan.x1[n] = x[1];
  plan.x2[n] = x[2];
  left =
      std::max(left, std::abs(x[0] - aim.x0[n]) + std::abs(x[1] - aim.x1[n]));
  return left / model_error;
}

double path_model::evaluate(workspace& w) const noexcept {
  const auto m = w.padded;
  const auto& x = w.plan;
  const auto& c = w.cost;
  assert(w.is_sized());
  assert(w.rows.discs >= 1 && w.rows.discs <= path_rows::most_discs);
  double twice = 0, least = 1, most = 0;
#pragma omp simd reduction(+ : twice) reduction(min : least)                   \
    reduction(max : most)
  for (int k = 0; k < m; ++k) {
    const double off = x.x0[k] - reference.wanted[k];
    twice += c.h00[k] * (off * off) + c.h11[k] * (x.x1[k] * x.x1[k])
             + c.h22[k] * (x.x2[k] * x.x2[k]) + c.r[k] * (x.u[k] * x.u[k]);
    const double q = 1 - x.x0[k] * reference.curvature[k];
    const double heading = std::abs(x.x1[k]);
    least = q < least ? q : least;
    most = heading > most ? heading : most;
  }
  auto& sine = w.direction.x1; // scratch
#pragma omp simd
  for (int k = 0; k < m; ++k) {
    sine[k] = sin_cos(x.x1[k]).sine;
    w.rows.curvature.c[k] = x.x2[k];
    w.rows.rate.c[k] = x.u[k];
  }
  for (int j = 0; j < w.rows.discs; ++j) {
    auto& row = w.rows.disc[static_cast<std::size_t>(j)];
    const double l = ahead[static_cast<std::size_t>(j)];
#pragma omp simd
    for (int k = 0; k < m; ++k)
      row.c[k] = x.x0[k] + l * sine[k];
  }
  for (int k = w.n + 1; k < m; ++k)
    sine[k] = 0;
  assert(!(twice < 0)); // no weight is
  const auto holds = least > least_q && most <= most_heading_rad;
  return holds ? twice / 2 : std::numeric_limits<double>::infinity();
}

} // namespace sofof::planners::ocp
