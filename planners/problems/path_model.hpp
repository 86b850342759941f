// Offset, heading error and curvature along a reference line: the dynamics of
// the path problem, and how the solver sees it.
#pragma once

#include "planners/ocp/trigonometry.hpp"
#include "planners/ocp/workspace.hpp"

#include <array>
#include <cassert>

namespace sofof::planners {

/// Against the reference line, at the rear axle.
struct path_state {
  double d_m = 0;           ///< Offset, left positive.
  double heading_rad = 0;   ///< Heading error θ, |θ| <= 1.
  double curvature_1pm = 0; ///< Of the driven path.
};

namespace ocp {

/// d' = (1 − d κ_r) tan θ, θ' = (1 − d κ_r) κ / cos θ − κ_r, κ' = u, over a
/// step along the reference by the midpoint rule.
/// @param x          d, θ, κ.
/// @param u          dκ/ds, 1/m².
/// @param reference  κ_r at the beginning, 1/m.
/// @param halfway    κ_r in the middle, 1/m.
/// Source: kinematic bicycle, rear axle, in the frame of a curve
/// (docs/planner.md).
template <class T>
std::array<T, 3> path_step(const std::array<T, 3>& x, T u, double reference,
                           double halfway, double ds) {
  assert(ds > 0);
  const auto slopes = [](T d, T heading, T curvature, double ref) {
    const auto [sine, cosine] = sin_cos(heading);
    const T q = (1. - d * ref) / cosine;
    return std::array<T, 2>{q * sine, q * curvature - ref};
  };
  const double half = ds / 2;
  const auto f = slopes(x[0], x[1], x[2], reference);
  const auto g =
      slopes(x[0] + half * f[0], x[1] + half * f[1], x[2] + half * u, halfway);
  return {x[0] + ds * g[0], x[1] + ds * g[1], x[2] + ds * u};
}

/// The rows of the path problem: discs in the corridor, curvature, its rate.
struct path_rows {
  static constexpr int most_discs = 4;
  static constexpr row_pattern on_disc{entry::one, entry::varying, entry::zero,
                                       entry::zero};
  static constexpr row_pattern on_curvature{entry::zero, entry::zero,
                                            entry::one, entry::zero};
  static constexpr row_pattern on_rate{entry::zero, entry::zero, entry::zero,
                                       entry::one};

  std::array<row<on_disc>, most_discs> disc;
  row<on_curvature> curvature;
  row<on_rate> rate;
  int discs = 0;

  /// Calls f(row, number).
  void each(auto f) { each_of(*this, f); }
  void each(auto f) const { each_of(*this, f); }

private:
  static void each_of(auto& rows, auto& f) {
    for (int i = 0; i < rows.discs; ++i)
      f(rows.disc[static_cast<std::size_t>(i)], i);
    f(rows.curvature, most_discs);
    f(rows.rate, most_discs + 1);
  }
};

/// The reference line; beyond knot n 0.
struct path_reference {
  column curvature; ///< κ_r at the knots ...
  column halfway;   ///< ... and half a step behind them.
  column wanted;    ///< d_ref.
};

/// What `ms_al` solves.
class path_model {
public:
  static constexpr dynamics_pattern dynamics{
      .a00 = entry::varying,
      .a01 = entry::varying,
      .a02 = entry::varying,
      .a10 = entry::varying,
      .a11 = entry::varying,
      .a12 = entry::varying,
      .a20 = entry::zero,
      .a21 = entry::zero,
      .a22 = entry::one,
      .b0 = entry::zero,
      .b1 = entry::varying,
      .b2 = entry::constant,
  };
  static constexpr hessian_pattern cost_hessian{
      .h00 = entry::varying,
      .h01 = entry::zero,
      .h02 = entry::zero,
      .h11 = entry::varying,
      .h12 = entry::zero,
      .h22 = entry::varying,
      .s0 = entry::zero,
      .s1 = entry::zero,
      .s2 = entry::zero,
      .r = entry::varying,
  };
  static constexpr hessian_pattern hessian{
      .h00 = entry::varying,
      .h01 = entry::varying,
      .h02 = entry::zero,
      .h11 = entry::varying,
      .h12 = entry::zero,
      .h22 = entry::varying,
      .s0 = entry::zero,
      .s1 = entry::zero,
      .s2 = entry::zero,
      .r = entry::varying,
  };
  using row_set = path_rows;
  using workspace = ocp::workspace<path_model>;

  /// The dynamics hold no further from the reference than this.
  static constexpr double least_q = 0.2; ///< 1 − d κ_r.
  static constexpr double most_heading_rad = 1;

  double ds = 1;
  const path_reference& reference;
  std::array<double, path_rows::most_discs> ahead{}; ///< Disc centres, m.
  /// How far a roll-out may leave the linear model, m plus rad.
  double model_error = 1e-3;

  void linearise(workspace& w) const noexcept;
  double roll_out(workspace& w) const noexcept;
  /// @returns the cost; infinity where the dynamics do not hold.
  double evaluate(workspace& w) const noexcept;
  double longest_step(const workspace&) const noexcept { return 1; }
};

} // namespace ocp
} // namespace sofof::planners
