// From where two bodies meet to when.
#include "planners/crossing/lag.hpp"

#include "planners/crossing/order_problem.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {

double lag_s(const world::meeting_curve& meet, const crossing_approach& first,
             const crossing_approach& second, double margin_s) {
  assert(first.drive && second.drive && margin_s >= 0);
  if (meet.is_empty() || meet.ends_m() < second.drive->begins_m())
    return order_problem::never_meet;
  constexpr auto step_m = world::meeting_curve::step_m;
  const auto to_m = std::min(meet.ends_m(), second.drive->ends_m());
  auto longest_s = order_problem::never_meet;
  for (auto at_m = std::max(meet.begins_m(), second.drive->begins_m()) + step_m;
       at_m <= to_m + step_m / 2; at_m += step_m) {
    const auto cleared_m = meet.cleared_m(at_m);
    if (cleared_m <= first.drive->begins_m())
      continue; // it has
    longest_s = std::max(longest_s, first.drive->time_s(cleared_m) + margin_s
                                        - second.drive->time_s(at_m));
  }
  return longest_s + second.line_s() - first.line_s();
}

} // namespace sofof::planners
