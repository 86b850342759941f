// The path problem: where to drive within a corridor, as an optimal-control
// problem over the arc length of a reference line.
#pragma once

#include "planners/ocp/carry_over.hpp"
#include "planners/ocp/kept_plan.hpp"
#include "planners/ocp/status.hpp"
#include "planners/problems/path_model.hpp"

#include <span>

namespace sofof::planners {

/// The corridor of one disc of the vehicle: bounds on its centre's offset.
/// The disc's radius is already taken off.
struct disc_corridor {
  double ahead_m = 0;           ///< Disc centre before the rear axle, m.
  std::span<const double> lo_m; ///< At knots 0..N; knot 0 bounds nothing.
  std::span<const double> hi_m;
};

/// What a metre of the plan costs.
struct path_weights {
  double offset = 0.05;   ///< 1/m², on (d − d_ref)².
  double heading = 1;     ///< On θ².
  double curvature = 20;  ///< m², on κ².
  double rate = 200;      ///< m⁴, on (dκ/ds)².
  double end_factor = 10; ///< m; the state's terms at the last knot.
};

/// min Σ ds [w_d (d − d_ref)² + w_θ θ² + w_κ κ² + w_u u²] + end, subject to
/// `path_step`, the corridor, and bounds on κ (at knots 1..N) and on u (in
/// steps 0..N−1). See docs/planner.md.
struct path_problem {
  int steps = 0; ///< N, 1..ocp::most_steps.
  double ds_m = 1;
  path_state start;                      ///< Kept exactly.
  std::span<const double> curvature_1pm; ///< κ_r every ds/2: 2 N + 1.
  std::span<const double> wanted_m;      ///< d_ref: N + 1.
  std::span<const disc_corridor> discs;  ///< 1..path_rows::most_discs.
  double curvature_max_1pm = 0.2;
  double rate_max_1pm2 = 0.1;
  /// A tighter bound on |u| in each step, N; empty: none.
  std::span<const double> rate_max_at_1pm2;
  path_weights weights;
};

/// Penalties and tolerances of the bounds.
struct path_options {
  struct numbers {
    double corridor, curvature, rate;
  };
  numbers warm{1e3, 1e5, 1e6};
  numbers cold{1e2, 1e4, 1e5};
  numbers tolerances{1e-4, 1e-5, 1e-5}; ///< m, 1/m, 1/m².
  double model_error = 1e-3;            ///< See path_model.
  ocp::solver_options solver;
};

/// A solver with its workspace: no heap, no clock, byte-wise copyable.
class path_ocp {
public:
  /// The bounds, as `violation::row` numbers them; 0..3: the discs.
  static constexpr int curvature_row = ocp::path_rows::most_discs;
  static constexpr int rate_row = curvature_row + 1;

  /// @param from  warm: from the plan in here, see `carry_over`; cold when
  /// there
  ///              is none on this grid.
  /// @returns BAD_INPUT for numbers that are not finite (bounds may be
  /// infinite), wrong lengths, ds <= 0, weights or limits < 0, |θ| > 1 at the
  /// start, 1 − d κ_r <= 0.2 at the start or where the plan is wanted;
  /// SOFT_INFEASIBLE at once where lo > hi.
  ocp::solve_report solve(const path_problem& problem, ocp::start from,
                          const path_options& options = {},
                          const ocp::budget& go_on = {}) noexcept;

  /// Carries plan and multipliers over to the grid of the next problem; what
  /// makes no sense as such leaves nothing to go on from.
  /// @param by_m   Where it begins on the old one, m, >= 0.
  /// @param ds_m   Its step, > 0 ...
  /// @param steps  ... and length, 1..ocp::most_steps.
  void carry_over(double by_m, double ds_m, int steps) noexcept;

  /// The same by whole knots, on the same grid.
  void shift(int knots) noexcept { carry_over(knots * ds_m_, ds_m_, w_.n); }

  /// Takes out what a later solve, with this solver or another, goes on from.
  /// @param out  Empty if there is no plan.
  void keep(ocp::kept_plan& out) const;

  /// Restores the state after the solve that `from` was kept of.
  void resume(const ocp::kept_plan& from);

  int steps() const { return w_.n; }

  /// The plan: N + 1 knots, N controls; the states are the roll-out of the
  /// controls. After BAD_INPUT, or a SOFT_INFEASIBLE without iterations, it is
  /// the plan before.
  std::span<const double> offset_m() const { return w_.knots(w_.plan.x0); }
  std::span<const double> heading_rad() const { return w_.knots(w_.plan.x1); }
  std::span<const double> curvature_1pm() const { return w_.knots(w_.plan.x2); }
  std::span<const double> rate_1pm2() const {
    return w_.knots(w_.plan.u).first(static_cast<std::size_t>(w_.n));
  }

  /// For tests: all the solver knows.
  const ocp::path_model::workspace& inside() const { return w_; }

private:
  void set_up(const path_problem&, const path_options&, ocp::start) noexcept;
  void guess(const path_problem&) noexcept;

  // By value, as in velocity_ocp.hpp, where Clang 16 needs it.
  ocp::path_model::workspace w_ = ocp::path_model::workspace();
  ocp::path_reference reference_{};
  double ds_m_ = 1;      ///< Of the plan.
  bool started_ = false; ///< There is a plan in the workspace.
};

} // namespace sofof::planners
