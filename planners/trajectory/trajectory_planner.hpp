// What every planner does: from own motion and the scene to a trajectory.
#pragma once

#include "planners/ocp/status.hpp"
#include "planners/scene/planning_input.hpp"
#include "planners/speed/comfort_limits.hpp"
#include "world/vehicle/plan_comfort.hpp"
#include "world/vehicle/trajectory.hpp"

#include <cstdint>
#include <optional>

namespace sofof::planners {

/// Where a published trajectory comes from.
enum class plan_origin : std::uint8_t {
  planned, ///< Made in this cycle.
  kept,    ///< The one before, which still holds; the new one was no good.
  stop,    ///< Braking, because there was nothing better.
};

constexpr plan_origin last_of(plan_origin) {
  return plan_origin::stop;
}

/// How a plan came about; it travels with the plan.
struct plan_report {
  plan_origin origin = plan_origin::planned;
  ocp::solve_status path = ocp::solve_status::converged;
  ocp::solve_status velocity = ocp::solve_status::converged;
  bool emergency = false;      ///< It asks for more than comfort allows.
  double violation = 0;        ///< The largest of both problems' bounds.
  std::int32_t iterations = 0; ///< Newton steps of all candidates.
  std::int32_t candidates = 1; ///< Plans that were weighed.
  std::uint32_t choice = 0;    ///< Which of them: sides and orders, as bits.
  bool is_late = false;        ///< It does not keep to what was agreed.
  time_point input;            ///< When what it was made from held.
  /// Of the plan as it was made; on the air it is rounded.
  std::optional<world::motion_extremes> extremes;
};

void visit_fields(auto& v, plan_report& x) {
  v("origin", x.origin);
  v("path", x.path);
  v("velocity", x.velocity);
  v("emergency", x.emergency);
  v("violation", x.violation);
  v("iterations", x.iterations);
  v("candidates", x.candidates);
  v("choice", x.choice);
  v("input", x.input);
  v("extremes", x.extremes);
}

/// Measures a plan as it was made, and calls it an emergency where it asks for
/// more than comfort allows: it may steer late, or end a plan that did.
void tell_extremes(const world::trajectory& plan, const comfort_limits& style,
                   plan_report& report);

/// Plans cycle by cycle: a plan continues the plan before.
class trajectory_planner {
public:
  virtual ~trajectory_planner() = default;

  /// Plans from `now` on; always gives a plan.
  /// @param input     May be older than `now`; where to begin: `joined`.
  /// @param previous  The plan in use so far, whoever made it; null if none.
  ///                  Not `&out`. One that begins later than the last plan
  ///                  made here is another planner's.
  /// @param out       The plan; its points are reused, so that a control loop
  ///                  needs no heap after the first cycles.
  ///                  `out.start == now`.
  /// @param go_on     When to stop trying.
  virtual plan_report plan(time_point now, const planning_input& input,
                           const world::trajectory* previous,
                           world::trajectory& out,
                           const ocp::budget& go_on = {}) = 0;
};

/// Where a new plan begins: where `previous` covers `now` and agrees with the
/// input within 0.5 m and 1 m/s, at its point for `now`, so that plans join
/// without a jolt; else at the input, moved on at constant acceleration. Of an
/// input that no car can have, only what is possible counts. Own motion only.
planning_input joined(const world::route& way, time_point now,
                      const planning_input& input,
                      const world::trajectory* previous);

/// @returns the car ahead as it will be at `now`: on at constant speed, or at
/// its braking until it stands, by half a second at most.
lead_vehicle moved_forward(lead_vehicle lead, time_point seen, time_point now);

} // namespace sofof::planners
