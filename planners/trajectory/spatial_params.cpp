// What can be set of the trajectory planner, and within which ranges.
#include "planners/trajectory/spatial_params.hpp"

#include "planners/ocp/workspace.hpp"
#include "planners/speed/speed_planner.hpp"

namespace sofof::planners {

void spatial_params::visit_options(option_visitor& s) {
  s.field("horizon_m", horizon_m, {20, 200});
  s.field("step_m", step_m, {0.25, 2});
  if (horizon_m / step_m > ocp::most_steps)
    s.refuse("step_m", "must be at least horizon_m / 256.");
  if (horizon_m / step_m < speed_planner::fewest_steps)
    s.refuse("step_m", "must be at most horizon_m / 16.");
  s.field("candidates", candidates, {1, 16});
  s.field("alternations", alternations, {1, 4});
  s.field("cautious_sight_m", cautious_sight_m, {0, 200});
}

} // namespace sofof::planners
