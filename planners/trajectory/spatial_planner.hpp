// The trajectory planner: a path, then speeds on it, both optimal, again and
// again, for the best of several ways past the others.
#pragma once

#include "planners/path/path_planner.hpp"
#include "planners/speed/speed_planner.hpp"
#include "planners/trajectory/maneuver_candidates.hpp"
#include "planners/trajectory/spatial_params.hpp"
#include "planners/trajectory/told_bounds.hpp"
#include "planners/trajectory/trajectory_planner.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace sofof::planners {

/// Path–velocity decomposition over arc length; both parts by the
/// augmented-Lagrangian iLQR of planners/ocp. A plan that fails is replaced by
/// the one before as long as that is safe, then by braking; if numbers are not
/// finite, by the safe stop (docs/planner.md, "What is published").
/// Source: docs/planner.md.
class spatial_planner final : public trajectory_planner {
public:
  /// @param way  Of the same style.
  spatial_planner(route_profile_ptr way, const comfort_limits& style,
                  const spatial_params& params);

  plan_report plan(time_point now, const planning_input& input,
                   const world::trajectory* previous, world::trajectory& out,
                   const ocp::budget& go_on = {}) override;

private:
  /// What a cycle starts from.
  struct scene {
    time_point now;
    planning_input start;
    const driving_scene& others;
    double age_s;                    ///< Of what is known of them.
    const world::trajectory* in_use; ///< If there is a plan.
  };

  void forget();
  bool plan_path(const scene& at, plan_report& report,
                 const ocp::budget& go_on);
  void list_users(const scene& at);
  bool plan_speed(const scene& at, plan_report& report,
                  const ocp::budget& go_on);
  speed_constraints task(const scene& at);
  crossing_car crossing(const scene& at) const;
  double kept_free_m(const speed_constraints& t, const scene& at) const;
  bool rests_among(const speed_profile& motion, const scene& at) const;
  bool keep(const world::trajectory& previous, const scene& at,
            world::trajectory& out);
  bool avoids_crossings() const;
  bool passes(const world::trajectory& plan,
              std::span<const lane_obstacle> bodies) const;
  void publish(time_point now, world::trajectory& out) const;
  void list_bodies(const scene& at);
  double lane_m(double s_m) const;
  double meets_m(const lane_obstacle& body) const;
  double way_from_car(double s_m) const;
  std::size_t most() const {
    return static_cast<std::size_t>(params_.candidates);
  }
  lane_obstacle met(const lane_obstacle& body, double age_s) const;

  const world::route& lane() const { return way_->line.way(); }

  route_profile_ptr way_;
  comfort_limits style_;
  spatial_params params_;
  world::vehicle_params car_;
  // The plan in use, and one to try others with as soon as there are any.
  std::unique_ptr<path_planner> path_, other_path_;
  std::unique_ptr<speed_planner> speed_, other_speed_;
  double way_m_ = 0;        // of the car on its path, ...
  double s_m_ = 0;          // ... and on its route
  double blocked_s_m_ = 0;  // where a body begins that leaves no room
  std::uint32_t sides_ = 0; // chosen last
  crossing_choice crossed_; // decided last
  std::vector<lane_obstacle> bodies_;
  std::vector<crossing_user> users_;
  std::vector<passing_order> all_sides_;
  std::vector<crossing_order> all_orders_;
  told_bounds agreed_, told_;
  speed_profile kept_;
  std::optional<time_point> made_;      // start of the last plan
  std::optional<time_point> kept_from_; // start of the plan that is kept
};

} // namespace sofof::planners
