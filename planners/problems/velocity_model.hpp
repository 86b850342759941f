// Time, half the squared speed and acceleration along a path: the dynamics of
// the velocity problem, and how the solver sees it.
#pragma once

#include "planners/ocp/workspace.hpp"

#include <array>
#include <cmath>
#include <complex>

namespace sofof::planners {

struct velocity_state {
  double t_s = 0;        ///< When the vehicle is there.
  double w_m2ps2 = 0;    ///< v²/2.
  double accel_mps2 = 0; ///< dw/ds.
};

namespace ocp {

/// Keeps times finite at standstill.
inline constexpr double crawl_mps = 0.5;

/// v(w) = sqrt(2 max(w, 0) + crawl²), so that 0.5 m/s are driven at rest.
template <class T>
T speed_of(T w) {
  using std::real;
  using std::sqrt;
  const T positive = real(w) > 0 ? w : T(0);
  return sqrt(2. * positive + crawl_mps * crawl_mps);
}

/// w' = a, a' = u exactly; t by the trapezoidal rule on speeds.
/// @param x  t, w, a.
/// @param u  da/ds, 1/s².
/// Source: docs/planner.md.
template <class T>
std::array<T, 3> velocity_step(const std::array<T, 3>& x, T u, double ds) {
  const T next = x[1] + ds * x[2] + ds * ds / 2 * u;
  return {x[0] + 2 * ds / (speed_of(x[1]) + speed_of(next)), next,
          x[2] + ds * u};
}

/// The rows of the velocity problem.
struct velocity_rows {
  static constexpr row_pattern on_t{entry::one, entry::zero, entry::zero,
                                    entry::zero};
  static constexpr row_pattern on_w{entry::zero, entry::one, entry::zero,
                                    entry::zero};
  static constexpr row_pattern on_a{entry::zero, entry::zero, entry::one,
                                    entry::zero};
  static constexpr row_pattern on_w_and_a{entry::zero, entry::varying,
                                          entry::varying, entry::zero};
  static constexpr row_pattern on_w_and_u{entry::zero, entry::varying,
                                          entry::zero, entry::varying};

  row<on_t> time;
  row<on_w> speed;
  row<on_a> accel;
  row<on_w_and_a> total; ///< Length of (a, v² κ).
  row<on_w_and_u> jerk;  ///< u v.
  bool timed = true;     ///< Some time is bounded.

  /// Calls f(row, number); leaves out times when none is bounded.
  void each(auto f) { each_of(*this, f); }
  void each(auto f) const { each_of(*this, f); }

private:
  static void each_of(auto& rows, auto& f) {
    if (rows.timed)
      f(rows.time, 0);
    f(rows.speed, 1);
    f(rows.accel, 2);
    f(rows.total, 3);
    f(rows.jerk, 4);
  }
};

/// The path and what is wanted on it; beyond knot n 0.
struct velocity_reference {
  column wanted;       ///< w_ref.
  column curvature;    ///< κ.
  column speed_weight; ///< Half of it times (w − w_ref)² is cost.
  column jerk_weight;  ///< Half of it times (u v)² is cost.
};

/// What `ms_al` solves. Of the jerk's cost and of rows that bend it sees the
/// Gauss–Newton part.
class velocity_model {
public:
  static constexpr dynamics_pattern dynamics{
      .a00 = entry::one,
      .a01 = entry::varying,
      .a02 = entry::varying,
      .a10 = entry::zero,
      .a11 = entry::one,
      .a12 = entry::constant,
      .a20 = entry::zero,
      .a21 = entry::zero,
      .a22 = entry::one,
      .b0 = entry::varying,
      .b1 = entry::constant,
      .b2 = entry::constant,
  };
  static constexpr hessian_pattern cost_hessian{
      .h00 = entry::zero,
      .h01 = entry::zero,
      .h02 = entry::zero,
      .h11 = entry::varying,
      .h12 = entry::zero,
      .h22 = entry::varying,
      .s0 = entry::zero,
      .s1 = entry::varying,
      .s2 = entry::zero,
      .r = entry::varying,
  };
  static constexpr hessian_pattern hessian{
      .h00 = entry::varying,
      .h01 = entry::zero,
      .h02 = entry::zero,
      .h11 = entry::varying,
      .h12 = entry::varying,
      .h22 = entry::varying,
      .s0 = entry::zero,
      .s1 = entry::varying,
      .s2 = entry::zero,
      .r = entry::varying,
  };
  using row_set = velocity_rows;
  using workspace = ocp::workspace<velocity_model>;

  double ds = 1;
  const velocity_reference& reference;
  /// How far a roll-out may leave the linear model.
  struct errors {
    double time_s = 1e-3;
    double jerk_mps3 = 5e-3;
  };
  errors model_error{};

  void linearise(workspace& w) const noexcept;
  double roll_out(workspace& w) const noexcept;
  double evaluate(workspace& w) const noexcept;
  double longest_step(const workspace& w) const noexcept;
};

} // namespace ocp
} // namespace sofof::planners
