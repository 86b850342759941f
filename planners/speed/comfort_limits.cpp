// The options of driving.
#include "planners/speed/comfort_limits.hpp"

#include <fmt/format.h>

namespace sofof::planners {

void comfort_limits::visit_options(option_visitor& s) {
  s.field("horizon_s", horizon_s, {1, 20});
  s.field("step_s", step_s, {0.02, 0.5});
  s.field("max_accel_mps2", max_accel_mps2, {0.3, 5});
  s.field("comfort_decel_mps2", comfort_decel_mps2, {0.5, 4});
  s.field("max_decel_mps2", max_decel_mps2, {least_emergency_mps2, 12});
  if (max_decel_mps2 < firm_decel_mps2())
    s.refuse("max_decel_mps2",
             fmt::format("must be at least {:g}, 1.25 times "
                         "comfort_decel_mps2: an emergency brakes firmer.",
                         firm_decel_mps2()));
  s.field("max_jerk_mps3", max_jerk_mps3, {0.5, 10});
  s.field("emergency_jerk_mps3", emergency_jerk_mps3, {1, 50});
  s.field("max_lateral_accel_mps2", max_lateral_accel_mps2, {0.5, 8});
  s.field("time_gap_s", time_gap_s, {0.5, 5});
  s.field("standstill_gap_m", standstill_gap_m, {1, 20});
  s.field("centring_length_m", centring_length_m, {5, 100});
}

} // namespace sofof::planners
