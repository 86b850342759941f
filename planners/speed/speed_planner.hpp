// When to be where on a path: the velocity problem set up from limits, bends
// and other road users, and what to do where it does not fit.
#pragma once

#include "planners/path/planned_path.hpp"
#include "planners/problems/velocity_ocp.hpp"
#include "planners/speed/comfort_limits.hpp"
#include "planners/speed/route_profile.hpp"
#include "planners/speed/speed_constraints.hpp"
#include "planners/speed/speed_profile.hpp"

#include <optional>
#include <vector>

namespace sofof::planners {

/// How a speed plan came about.
enum class speed_mode : unsigned char {
  optimal,  ///< The velocity problem, solved.
  stands,   ///< It has no way to go.
  moves_up, ///< A few metres at walking pace.
  brakes,   ///< In an emergency, or because nothing else was found.
};

/// Plans speeds that continue each other.
class speed_planner {
public:
  /// Fewer steps are too coarse to stop with.
  static constexpr int fewest_steps = 16;

  struct grid {
    double ds_m = 1;
    int steps = 80; ///< At least `fewest_steps`.
  };
  struct result {
    speed_mode how = speed_mode::brakes;
    bool emergency = false; ///< Firmer than comfort allows.
    ocp::solve_report report;
    double price = 0; ///< What its motion costs, to compare plans.
  };

  /// @param way  Kept.
  speed_planner(route_profile_ptr way, const comfort_limits& style,
                grid horizon);

  /// @param path   Where the car drives.
  /// @param way_m  Where on the path it is.
  result plan(const planned_path& path, double way_m,
              const speed_constraints& task, const ocp::budget& go_on = {});

  /// The plan, seen from the car: ways begin at 0.
  const speed_profile& motion() const { return motion_; }

  /// Plans the next one from scratch.
  void forget() { solved_ = false; }

  /// The last resort on a path: braking, as firmly as needed.
  result brake_only(const speed_constraints& task);

private:
  struct stop { // of the rear axle, from the car on
    double wanted_m, last_m;
  };
  /// Where the velocity problem begins: the car, or where it has set off.
  struct beginning {
    lane_motion from; // way from the car on
    double at_s;      // from now on
  };
  /// What the velocity problem covers, from its beginning on.
  struct stretch {
    double stop_m, length_m, ds_m;
    int steps;
    bool stops; // at its end
  };
  stop find_stop(const speed_constraints& task) const;
  static double free_m(const speed_constraints& task, const stop& end);
  static bool is_to_be_passed(const speed_constraints& task, double way_m);
  double needed_decel(const speed_constraints& task) const;
  bool drive(const planned_path& path, double way_m,
             const speed_constraints& task, const stop& end, result& r,
             const ocp::budget& go_on);
  beginning begin(const speed_constraints& task);
  std::optional<stretch> find_stretch(double path_left_m,
                                      const lane_motion& from,
                                      const stop& end) const;
  double set_bounds(const planned_path& path, double way_m,
                    const speed_constraints& task, const beginning& start,
                    const stretch& ahead, bool& emergency);
  velocity_problem pose(const beginning& start, const stretch& ahead,
                        double decel_mps2, bool recovers) const;
  void solve(velocity_ocp& solver, const velocity_problem& p, double s_m,
             result& r, const ocp::budget& go_on);
  void set_limits(const planned_path& path, double from_m, double ds_m,
                  int steps);
  void be_cautious(const speed_constraints& task, double from_m, double ds_m);
  void set_windows(const speed_constraints& task, const lane_motion& from,
                   double ds_m);
  bool comes_too_late(const speed_constraints& task, const stop& end) const;
  bool too_fast_for_bends() const;
  bool yield_to_braking(const lane_motion& from, double from_s, double ds_m,
                        double decel_mps2);
  double price(const planned_path& path, double way_m) const;

  route_profile_ptr way_;
  comfort_limits style_;
  grid grid_;
  ocp::kept_plan kept_;      // what the solver goes on from
  bool solved_ = false;      // that can be carried over
  bool solved_stop_ = false; // and it ends at rest
  double solved_s_m_ = 0;    // it begins here
  speed_profile motion_;
  int steps_ = 0; // of the motion
  // The velocity problem, knot by knot.
  std::vector<double> w_max_, wanted_, bends_, earliest_, latest_, promised_;
};

} // namespace sofof::planners
