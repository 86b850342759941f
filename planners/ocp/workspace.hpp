// All that a solve works on: fixed sizes, knots side by side, no pointers.
#pragma once

#include "planners/ocp/series.hpp"

#include <cstddef>
#include <limits>
#include <span>

namespace sofof::planners::ocp {

inline constexpr double no_bound = std::numeric_limits<double>::infinity();

/// @returns how far t is beyond [lo, hi]: positive above, negative below.
constexpr double beyond(double t, double lo, double hi) {
  const double raised = t < lo ? lo : t;
  return t - (raised > hi ? hi : raised);
}

/// Which entries of dx[k+1] = A dx[k] + B du[k] + gap[k] are what.
struct dynamics_pattern {
  entry a00, a01, a02, a10, a11, a12, a20, a21, a22, b0, b1, b2;
};

template <dynamics_pattern p>
struct dynamics {
  [[no_unique_address]] series<p.a00> a00;
  [[no_unique_address]] series<p.a01> a01;
  [[no_unique_address]] series<p.a02> a02;
  [[no_unique_address]] series<p.a10> a10;
  [[no_unique_address]] series<p.a11> a11;
  [[no_unique_address]] series<p.a12> a12;
  [[no_unique_address]] series<p.a20> a20;
  [[no_unique_address]] series<p.a21> a21;
  [[no_unique_address]] series<p.a22> a22;
  [[no_unique_address]] series<p.b0> b0;
  [[no_unique_address]] series<p.b1> b1;
  [[no_unique_address]] series<p.b2> b2;
};

/// Which entries of the Hessian [H s; s' r] of a stage are what.
struct hessian_pattern {
  entry h00, h01, h02, h11, h12, h22, s0, s1, s2, r;
};

template <hessian_pattern p>
struct hessian {
  [[no_unique_address]] series<p.h00> h00;
  [[no_unique_address]] series<p.h01> h01;
  [[no_unique_address]] series<p.h02> h02;
  [[no_unique_address]] series<p.h11> h11;
  [[no_unique_address]] series<p.h12> h12;
  [[no_unique_address]] series<p.h22> h22;
  [[no_unique_address]] series<p.s0> s0;
  [[no_unique_address]] series<p.s1> s1;
  [[no_unique_address]] series<p.s2> s2;
  [[no_unique_address]] series<p.r> r;
};

/// Which entries of a row's gradient are what.
struct row_pattern {
  entry x0, x1, x2, u;
};

/// A two-sided bound lo <= c(x, u) <= hi at every knot, in the augmented
/// Lagrangian: with the shifted value t = c + y it costs rho/2 v², where
/// v = t - clamp(t, lo, hi) is what sticks out. The one signed multiplier is
/// rho·y, and the next one rho·v.
template <row_pattern p>
struct row {
  column lo, hi;
  column c;      ///< Value of the model.
  column y;      ///< Multiplier over rho.
  column v;      ///< What sticks out.
  column active; ///< rho where v is not 0, else 0.
  column dc;     ///< Change of c along the direction.
  [[no_unique_address]] series<p.x0> g0;
  [[no_unique_address]] series<p.x1> g1;
  [[no_unique_address]] series<p.x2> g2;
  [[no_unique_address]] series<p.u> gu;
  double rho = 1;         ///< Penalty.
  double least_rho = 1;   ///< What it began with.
  double last_change = 0; ///< Of the multipliers, in tolerances.
  double tolerance = 1;   ///< Violation that is none, in the unit of c.

  /// Takes the bounds off the first m knots and changes the penalty; the
  /// multipliers stay.
  void open(int m, double penalty, double violation) {
    const double scale = rho / penalty;
    for (int k = 0; k < m; ++k) {
      lo[k] = -no_bound;
      hi[k] = no_bound;
      y[k] *= scale;
    }
    rho = least_rho = penalty;
    tolerance = violation;
  }
};

/// Three numbers a knot and one for the control.
struct stages {
  column x0, x1, x2, u;
};

template <class Problem>
struct workspace {
  int n = 0;      ///< Steps; knots are 0..n.
  int padded = 0; ///< What loops run over; knots beyond n are neutral.

  stages iterate; ///< Of the model: its knots may not join yet.
  stages plan;    ///< The iterate, rolled out: it is published.

  dynamics<Problem::dynamics> model;
  column gap0, gap1, gap2; ///< What the next knot misses.

  hessian<Problem::cost_hessian> cost;
  stages slope; ///< Gradient of the cost.
  typename Problem::row_set rows;

  hessian<Problem::hessian> h; ///< Cost and active rows.
  stages g;                    ///< Gradient, likewise.
  column k0, k1, k2, kff;      ///< Feedback and feed-forward.
  column inverse;              ///< 1 / Quu.
  stages direction;

  /// @returns whether the lengths are ones that fit, and each other.
  bool is_sized() const {
    return n >= 1 && n <= most_steps && padded == ocp::padded(n + 1);
  }

  /// @returns the knots 0..n.
  std::span<const double> knots(const column& c) const {
    return std::span{c}.first(static_cast<std::size_t>(n) + 1);
  }
};

} // namespace sofof::planners::ocp
