// What a motion keeps off: lines, the car ahead, windows.
#pragma once

#include "planners/speed/speed_constraints.hpp"
#include "planners/speed/speed_profile.hpp"

namespace sofof::planners {

/// To a line, and behind another car, this must be kept in any case, m.
inline constexpr double least_line_gap_m = 0.15, least_gap_m = 1.0;
/// Comfort keeps off a window by so much more than an emergency does, s.
inline constexpr double window_slack_s = 0.4;

/// @param step_s  Between two moments of the motion.
/// @returns whether it is at no place outside its window, but for the slack.
bool keeps_windows(const speed_profile& motion, double step_s,
                   const speed_constraints& task);

/// @returns whether a motion keeps off lines and the car ahead, by less than
/// what a plan keeps: to judge plans that were made before, or badly.
bool is_clear(const speed_profile& motion, double step_s,
              const speed_constraints& task);

} // namespace sofof::planners
