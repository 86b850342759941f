// From where two bodies meet to when.
#include "planners/crossing/lag.hpp"

#include "planners/crossing/order_problem.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::planners {

double delay_s(const world::meeting_curve& meet, const way_motion& first,
               const way_motion& second, kept_apart gap) {
  assert(!first.empty() && !second.empty());
  assert(gap.by_s >= 0 && gap.by_m >= 0);
  if (meet.is_empty() || meet.ends_m() < second.begins_m())
    return order_problem::never_meet;
  constexpr auto step_m = world::meeting_curve::step_m;
  const auto to_m = std::min(meet.ends_m(), second.ends_m());
  auto longest_s = order_problem::never_meet;
  for (auto at_m = std::max(meet.begins_m(), second.begins_m()) + step_m;
       at_m <= to_m + step_m / 2; at_m += step_m) {
    const auto cleared_m = meet.cleared_m(at_m) + gap.by_m;
    if (cleared_m <= first.begins_m())
      continue; // it has
    longest_s = std::max(longest_s, first.time_s(cleared_m) + gap.by_s
                                        - second.time_s(at_m));
  }
  return longest_s;
}

} // namespace sofof::planners
