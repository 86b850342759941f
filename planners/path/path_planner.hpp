// Where to drive, again and again: the path problem over a horizon that moves
// along with the car.
#pragma once

#include "planners/path/planned_path.hpp"
#include "planners/problems/path_ocp.hpp"
#include "planners/scene/corridor.hpp"
#include "planners/scene/reference_line.hpp"

#include <vector>

namespace sofof::planners {

/// A car on its route, as path planning sees it.
struct path_start {
  double s_m = 0;
  path_state x;
};

/// Plans paths that continue each other. The knots stay where they are on the
/// line; the piece that the car is on stays as it was planned, so that the
/// path below the car never jumps. A car that is off its path begins a new
/// one.
class path_planner {
public:
  struct grid {
    double ds_m = 1;
    int steps = 80;
  };
  /// A body in the lane and the side to pass it on.
  struct passing {
    lane_obstacle body;
    side_of_road side = side_of_road::left;
  };

  /// @param line  Must outlive this.
  path_planner(const reference_line& line, grid horizon)
      : line_{&line}, grid_{horizon} {}

  /// Plans on; nothing happens while the car stays between two knots and
  /// nothing stands in the lane.
  /// @returns the status of the last solve. A plan that is not publishable is
  /// taken if it misses the corridor by 0.1 m at most. Else the path stays as
  /// it was and ends earlier; a car that was off it has none.
  ocp::solve_report plan(const path_start& car, std::span<const passing> others,
                         const ocp::budget& go_on = {});

  /// The path; empty before the first good plan.
  const planned_path& path() const { return path_; }

  /// Begins a new path with the next plan.
  void forget() { path_.size = 0; }

  /// @returns whether the last call could plan on.
  bool settled() const { return settled_; }

  /// @returns whether the car is on the path.
  bool follows(const path_start& car) const;

private:
  bool solve(path_ocp& solver, double s_m, const path_state& from,
             ocp::start how, std::span<const passing> others,
             const ocp::budget& go_on);
  bool attempt(path_ocp& solver, double s_m, const path_state& from,
               ocp::start how, std::span<const passing> others,
               corridor::steering steers, const ocp::budget& go_on);
  void adopt(const path_ocp& solved, double s_m, int first);

  const reference_line* line_;
  grid grid_;
  lane_bounds lane_;
  ocp::kept_plan kept_; // what the solver goes on from
  planned_path path_;
  int frozen_ = 0;        // knots of the path before the solver's first
  bool narrowed_ = false; // something was in the lane
  bool settled_ = false;  // what is kept is of the path
  ocp::solve_report report_;
  std::vector<double> bends_, wanted_;
};

} // namespace sofof::planners
