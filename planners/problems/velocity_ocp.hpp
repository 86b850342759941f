// The velocity problem: when to be where on a given path, as an
// optimal-control problem over its arc length.
#pragma once

#include "planners/ocp/carry_over.hpp"
#include "planners/ocp/kept_plan.hpp"
#include "planners/ocp/status.hpp"
#include "planners/problems/velocity_model.hpp"

#include <optional>
#include <span>

namespace sofof::planners {

/// What a metre of the plan costs.
struct velocity_weights {
  double speed = 0.1; ///< On (w − w_ref)² / (2 w_ref), about (v − v_ref)².
  double accel = 1;   ///< On a².
  double jerk = 1;    ///< On (u v)².
  double end_m = 4;   ///< The state's terms at the last knot, m.
};

struct velocity_limits {
  double accel_min_mps2 = -2.5;
  double accel_max_mps2 = 2.5;
  double jerk_max_mps3 = 1.5;
  double total_max_mps2 = 2.5; ///< On the length of (a, v² κ) ...
  int total_from = 6;          ///< ... from this knot on.
};

/// min Σ ds [q_v (w − w_ref)²/(2 w_ref) + q_a a² + q_j (u v)²] + end, subject
/// to `velocity_step` and bounds on t, w, a, (a, v² κ) (at knots 1..N) and on
/// the jerk u v (in steps 0..N−1). See docs/planner.md.
struct velocity_problem {
  int steps = 0; ///< N, 1..ocp::most_steps.
  double ds_m = 0.5;
  velocity_state start; ///< Kept exactly.
  /// All N + 1; entry 0 bounds nothing. Without a bound, times are infinite.
  std::span<const double> w_max_m2ps2;
  std::span<const double> wanted_m2ps2; ///< w_ref, > 0.
  std::span<const double> curvature_1pm;
  std::span<const double> earliest_s;
  std::span<const double> latest_s;
  /// From this knot on, >= 1, the vehicle rests: w = 0 and a = 0.
  std::optional<int> stop_knot;
  velocity_limits limits;
  velocity_weights weights;
};

/// Penalties and tolerances of the bounds.
struct velocity_options {
  struct numbers {
    double time, speed, accel, total, jerk;
  };
  numbers warm{5e3, 1e3, 300, 300, 300};
  numbers cold{1e3, 300, 30, 30, 30};
  numbers tolerances{5e-4, 5e-4, 5e-4, 5e-4, 5e-4}; ///< s, m²/s², m/s², m/s³.
  ocp::velocity_model::errors model_error;
  /// When the last plan misses a time window by more, the world has changed,
  /// and the iteration starts cold.
  double surprise_s = 0.5;
  ocp::solver_options solver{
      .max_iterations = 100, .max_linearisations = 60, .max_inner = 8};
};

/// A solver with its workspace: no heap, no clock, byte-wise copyable.
class velocity_ocp {
public:
  /// The bounds, as `violation::row` numbers them.
  static constexpr int time_row = 0, speed_row = 1, accel_row = 2,
                       total_row = 3, jerk_row = 4;

  /// @param from  warm: from the plan in here, see `carry_over`; cold when
  /// there
  ///              is none on this grid.
  /// @returns BAD_INPUT for numbers that are not finite (bounds on time may
  /// be infinite), wrong lengths, ds <= 0, w < 0, w_ref <= 0, weights < 0,
  /// limits of the wrong sign; SOFT_INFEASIBLE at once where lo > hi, or
  /// where even full braking or full acceleration breaks a bound.
  ocp::solve_report solve(const velocity_problem& problem, ocp::start from,
                          const velocity_options& options = {},
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
  std::span<const double> t_s() const { return w_.knots(w_.plan.x0); }
  std::span<const double> w_m2ps2() const { return w_.knots(w_.plan.x1); }
  std::span<const double> accel_mps2() const { return w_.knots(w_.plan.x2); }
  std::span<const double> u_1ps2() const {
    return w_.knots(w_.plan.u).first(static_cast<std::size_t>(w_.n));
  }

  /// For tests: all the solver knows.
  const ocp::velocity_model::workspace& inside() const { return w_; }

private:
  void set_up(const velocity_problem&) noexcept;
  void set_bounds(const velocity_problem&, const velocity_options&,
                  ocp::start) noexcept;
  ocp::violation hopeless(const velocity_problem&) const noexcept;
  void guess(const velocity_problem&) noexcept;
  void follow(const velocity_problem&) noexcept;
  bool rests_elsewhere(const velocity_problem&) const noexcept;
  double misses_s() const noexcept;

  // Clang 16 makes wrong code of {} here when its sanitizer is on.
  ocp::velocity_model::workspace w_ = ocp::velocity_model::workspace();
  ocp::velocity_reference reference_{};
  double ds_m_ = 1;      ///< Of the plan.
  bool started_ = false; ///< There is a plan in the workspace.
};

} // namespace sofof::planners
