// What a motion keeps off.
#include "planners/speed/clearance.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>

namespace sofof::planners {
namespace {

/// What a plan that was made before may come closer still.
constexpr double slack_m = 0.1;

/// Promised times later than this, s, are not checked: until then plans are
/// made anew.
constexpr double until_anew_s = 5;

} // namespace

bool keeps_windows(const speed_profile& motion, double step_s,
                   const speed_constraints& task) {
  assert(step_s > 0 && !motion.empty());
  for (std::size_t i = 1; i < motion.size(); ++i) {
    const auto t = static_cast<double>(i) * step_s;
    for (const auto& window : task.windows)
      if (motion[i].s_m > window.at_m && motion[i - 1].s_m <= window.at_m
          && (t < window.earliest_s - window_slack_s
              || t > window.latest_s + window_slack_s))
        return false;
    const auto promised_s =
        t < until_anew_s && motion[i].s_m >= task.promised_from_m
            ? task.promised_s(motion[i].s_m)
            : std::nullopt;
    if (promised_s
        && (t < *promised_s - task.sooner_s - window_slack_s
            || t > *promised_s + task.later_s + window_slack_s))
      return false;
  }
  return true;
}

bool is_clear(const speed_profile& motion, double step_s,
              const speed_constraints& task) {
  assert(step_s > 0 && !motion.empty());
  assert(!std::isnan(task.stop_m));
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const auto t = static_cast<double>(i) * step_s;
    const auto& x = motion[i];
    if (x.s_m > task.stop_m - least_line_gap_m + slack_m)
      return false;
    if (task.ahead && x.s_m > task.ahead->at(t) - least_gap_m + slack_m)
      return false;
  }
  return keeps_windows(motion, step_s, task);
}

} // namespace sofof::planners
