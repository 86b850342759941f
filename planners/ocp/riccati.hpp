// The Newton step of a linear-quadratic problem: backwards for the feedback,
// forwards for the direction. Entries that are known to be 0 or 1 vanish.
#pragma once

#include "planners/ocp/workspace.hpp"

#include <cassert>

namespace sofof::planners::ocp {

/// Least curvature in the control that counts as convex.
inline constexpr double least_curvature = 1e-9;

/// Backward sweep: minimises g'e + e'He/2 over e = (dx, du), subject to
/// dx[k+1] = A dx[k] + B du[k] + gap[k]. Fills k0..k2, kff, inverse.
/// @param gaps  Whether gap[k] is other than 0.
/// @returns the Newton decrement Σ qu²/Quu (twice the expected decrease
/// without gaps); negative when the problem is not convex in u.
template <bool gaps, class Workspace>
double factorise(Workspace& w) noexcept {
  const auto& m = w.model;
  const auto& h = w.h;
  const auto& g = w.g;
  const auto n = w.n;
  double p00 = value(h.h00[n]), p01 = value(h.h01[n]), p02 = value(h.h02[n]);
  double p11 = value(h.h11[n]), p12 = value(h.h12[n]), p22 = value(h.h22[n]);
  double p0 = g.x0[n], p1 = g.x1[n], p2 = g.x2[n];
  double decrement = 0;
  bool convex = true;
  for (int k = n - 1; k >= 0; --k) {
    if constexpr (gaps) {
      const double d0 = w.gap0[k], d1 = w.gap1[k], d2 = w.gap2[k];
      p0 += p00 * d0 + p01 * d1 + p02 * d2;
      p1 += p01 * d0 + p11 * d1 + p12 * d2;
      p2 += p02 * d0 + p12 * d1 + p22 * d2;
    }
    const auto a00 = m.a00[k];
    const auto a01 = m.a01[k];
    const auto a02 = m.a02[k];
    const auto a10 = m.a10[k];
    const auto a11 = m.a11[k];
    const auto a12 = m.a12[k];
    const auto a20 = m.a20[k];
    const auto a21 = m.a21[k];
    const auto a22 = m.a22[k];
    const auto b0 = m.b0[k];
    const auto b1 = m.b1[k];
    const auto b2 = m.b2[k];
    // P A and P B, by rows of P.
    const double c00 = p00 * a00 + p01 * a10 + p02 * a20;
    const double c01 = p00 * a01 + p01 * a11 + p02 * a21;
    const double c02 = p00 * a02 + p01 * a12 + p02 * a22;
    const double c10 = p01 * a00 + p11 * a10 + p12 * a20;
    const double c11 = p01 * a01 + p11 * a11 + p12 * a21;
    const double c12 = p01 * a02 + p11 * a12 + p12 * a22;
    const double c20 = p02 * a00 + p12 * a10 + p22 * a20;
    const double c21 = p02 * a01 + p12 * a11 + p22 * a21;
    const double c22 = p02 * a02 + p12 * a12 + p22 * a22;
    const double e0 = p00 * b0 + p01 * b1 + p02 * b2;
    const double e1 = p01 * b0 + p11 * b1 + p12 * b2;
    const double e2 = p02 * b0 + p12 * b1 + p22 * b2;
    const double quu = h.r[k] + (b0 * e0 + b1 * e1 + b2 * e2);
    const double q0 = h.s0[k] + (b0 * c00 + b1 * c10 + b2 * c20);
    const double q1 = h.s1[k] + (b0 * c01 + b1 * c11 + b2 * c21);
    const double q2 = h.s2[k] + (b0 * c02 + b1 * c12 + b2 * c22);
    const double qu = g.u[k] + (b0 * p0 + b1 * p1 + b2 * p2);
    convex = convex && quu > least_curvature;
    const double inverse = 1 / quu;
    const double k0 = -q0 * inverse, k1 = -q1 * inverse, k2 = -q2 * inverse;
    w.inverse[k] = inverse;
    w.k0[k] = k0;
    w.k1[k] = k1;
    w.k2[k] = k2;
    w.kff[k] = -qu * inverse;
    decrement += qu * qu * inverse;
    p00 = h.h00[k] + (a00 * c00 + a10 * c10 + a20 * c20) + q0 * k0;
    p01 = h.h01[k] + (a00 * c01 + a10 * c11 + a20 * c21) + q0 * k1;
    p02 = h.h02[k] + (a00 * c02 + a10 * c12 + a20 * c22) + q0 * k2;
    p11 = h.h11[k] + (a01 * c01 + a11 * c11 + a21 * c21) + q1 * k1;
    p12 = h.h12[k] + (a01 * c02 + a11 * c12 + a21 * c22) + q1 * k2;
    p22 = h.h22[k] + (a02 * c02 + a12 * c12 + a22 * c22) + q2 * k2;
    const double n0 = g.x0[k] + (a00 * p0 + a10 * p1 + a20 * p2) + k0 * qu;
    const double n1 = g.x1[k] + (a01 * p0 + a11 * p1 + a21 * p2) + k1 * qu;
    const double n2 = g.x2[k] + (a02 * p0 + a12 * p1 + a22 * p2) + k2 * qu;
    p0 = n0, p1 = n1, p2 = n2;
  }
  assert(!convex || !(decrement < 0));
  return convex ? decrement : -1;
}

/// The same when only the gradient has changed since: a third of the work.
template <class Workspace>
double resolve(Workspace& w) noexcept {
  const auto& m = w.model;
  const auto& g = w.g;
  assert(w.n >= 1 && w.n <= most_steps);
  double p0 = g.x0[w.n], p1 = g.x1[w.n], p2 = g.x2[w.n];
  double decrement = 0;
  for (int k = w.n - 1; k >= 0; --k) {
    const double qu = g.u[k] + (m.b0[k] * p0 + m.b1[k] * p1 + m.b2[k] * p2);
    assert(!(w.inverse[k] <= 0)); // factorised, and convex
    const double kff = -qu * w.inverse[k];
    w.kff[k] = kff;
    decrement -= qu * kff;
    const double n0 = g.x0[k] + w.k0[k] * qu
                      + (m.a00[k] * p0 + m.a10[k] * p1 + m.a20[k] * p2);
    const double n1 = g.x1[k] + w.k1[k] * qu
                      + (m.a01[k] * p0 + m.a11[k] * p1 + m.a21[k] * p2);
    const double n2 = g.x2[k] + w.k2[k] * qu
                      + (m.a02[k] * p0 + m.a12[k] * p1 + m.a22[k] * p2);
    p0 = n0, p1 = n1, p2 = n2;
  }
  return decrement;
}

/// Forward sweep: the direction that the feedback gives, from dx[0] = 0.
template <bool gaps, class Workspace>
void sweep_forward(Workspace& w) noexcept {
  const auto& m = w.model;
  auto& e = w.direction;
  assert(w.n >= 1 && w.n <= most_steps);
  double x0 = 0, x1 = 0, x2 = 0;
  for (int k = 0; k < w.n; ++k) {
    const double u = w.kff[k] + w.k0[k] * x0 + w.k1[k] * x1 + w.k2[k] * x2;
    e.x0[k] = x0, e.x1[k] = x1, e.x2[k] = x2, e.u[k] = u;
    double n0 = m.a00[k] * x0 + m.a01[k] * x1 + m.a02[k] * x2 + m.b0[k] * u;
    double n1 = m.a10[k] * x0 + m.a11[k] * x1 + m.a12[k] * x2 + m.b1[k] * u;
    double n2 = m.a20[k] * x0 + m.a21[k] * x1 + m.a22[k] * x2 + m.b2[k] * u;
    if constexpr (gaps)
      n0 += w.gap0[k], n1 += w.gap1[k], n2 += w.gap2[k];
    x0 = n0, x1 = n1, x2 = n2;
  }
  e.x0[w.n] = x0, e.x1[w.n] = x1, e.x2[w.n] = x2;
}

} // namespace sofof::planners::ocp
