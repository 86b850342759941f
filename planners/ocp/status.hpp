// How a solve ended, in words that the rest of the planner can act upon.
#pragma once

#include <limits>
#include <string_view>

namespace sofof::planners::ocp {

enum class solve_status {
  converged,       ///< Optimal and feasible within the tolerances.
  acceptable,      ///< Not optimal yet; violation below 10 tolerances.
  soft_infeasible, ///< No plan keeps the bounds; the worst row is named.
  budget,          ///< Stopped by the deadline before it was acceptable.
  numerical,       ///< A number overflowed; there is no plan.
  bad_input,       ///< The problem itself makes no sense; nothing was done.
};

constexpr solve_status last_of(solve_status) {
  return solve_status::bad_input;
}

/// @returns the name in capitals, as in files: "CONVERGED".
constexpr std::string_view name(solve_status s) {
  switch (s) {
    case solve_status::converged:
      return "CONVERGED";
    case solve_status::acceptable:
      return "ACCEPTABLE";
    case solve_status::soft_infeasible:
      return "SOFT_INFEASIBLE";
    case solve_status::budget:
      return "BUDGET";
    case solve_status::numerical:
      return "NUMERICAL";
    case solve_status::bad_input:
      return "BAD_INPUT";
  }
  return "?";
}

/// How far a plan is beyond a bound, and where the worst place is.
struct violation {
  double amount = 0; ///< In the row's unit; 0 when all bounds are kept.
  double scaled = 0; ///< In tolerances of the row.
  int row = -1;      ///< Which bound, as numbered by the problem; -1: none.
  int knot = -1;

  /// Keeps the worse one, measured in tolerances.
  void keep_worse(double beyond, double tolerance, int at_row, int at_knot) {
    if (beyond > scaled * tolerance)
      *this = {beyond, beyond / tolerance, at_row, at_knot};
  }
};

/// What is known about a solve. `cost` and `worst` are those of the published
/// plan: its controls, rolled out from the start.
struct solve_report {
  solve_status status = solve_status::bad_input;
  double cost = std::numeric_limits<double>::quiet_NaN();
  double violation = 0;   ///< The largest, each in its row's unit.
  ocp::violation worst;   ///< The worst, in tolerances.
  int iterations = 0;     ///< Newton steps, all together.
  int linearisations = 0; ///< Of the dynamics.
};

/// @returns that bounds contradict each other, before anything was solved.
inline solve_report refusal(const violation& worst) {
  solve_report report;
  report.status = solve_status::soft_infeasible;
  report.violation = worst.amount;
  report.worst = worst;
  return report;
}

/// @returns whether a plan with this status may be driven without more ado.
constexpr bool publishable(solve_status s) {
  return s == solve_status::converged || s == solve_status::acceptable;
}

/// How hard to try. The defaults are the path problem's.
struct solver_options {
  int max_iterations = 60;     ///< Newton steps, all together.
  int max_linearisations = 20; ///< Of the dynamics.
  int max_inner = 30;          ///< Newton steps per linearisation.
  double decrement = 1e-6;     ///< One of a linear model that is solved.
  double optimality = 1e-4;    ///< Newton decrement of an optimum, as a
                               ///< share of the cost.
  double slow = 0.25;          ///< When multipliers change by more than this
                               ///< share of their last change, ...
  double firmer = 5;           ///< ... the penalty grows by this factor, ...
  double firmest = 100;        ///< ... while below so many times the first.
  double standstill = 0.97; ///< When they keep this share of their change ...
  int patience = 3;         ///< ... so often, no plan keeps the bounds.
};

/// Where the iteration starts.
enum class start {
  cold, ///< From a guess of the problem's own.
  warm, ///< From the plan and the multipliers in the workspace.
};

/// Asked once per Newton step, with the number of steps done, whether to go
/// on: a deadline on a clock of the caller's, or a count in virtual time.
class budget {
public:
  /// No limit but the options'.
  budget() = default;

  /// @param ask  bool(int steps_done) noexcept; must outlive the solve.
  template <class Ask>
  explicit budget(const Ask& ask)
      : state_{&ask}, ask_{[](const void* state, int steps) {
          return (*static_cast<const Ask*>(state))(steps);
        }} {}

  bool operator()(int steps) const noexcept {
    return ask_ == nullptr || ask_(state_, steps);
  }

private:
  const void* state_ = nullptr;
  bool (*ask_)(const void*, int) = nullptr;
};

} // namespace sofof::planners::ocp
