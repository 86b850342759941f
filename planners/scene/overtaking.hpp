// Whether there is time to pass what blocks a lane on its opposite.
#pragma once

#include "world/roads/route.hpp"

#include <span>

namespace sofof::planners {

/// What stands in the own lane, arc lengths on the own route.
struct blocked_stretch {
  double from_m = 0, to_m = 0;
};

/// Who is on the opposite lane, arc lengths on the own route.
struct oncoming_body {
  double front_m = 0, rear_m = 0; ///< Its bumpers, front_m first as it comes.
  double speed_mps = 0;           ///< Towards the own car, >= 0.
};

/// The own car.
struct overtaking_car {
  double rear_m = 0, front_m = 0; ///< Its bumpers, arc length.
  double speed_mps = 0;
  double sees_to_m = 0;   ///< On the opposite lane; arc length.
  bool has_begun = false; ///< It is leaving its lane, or has left it.
};

/// So far before a body a car begins to leave its lane at the latest, and so
/// far behind it is back in it, m.
constexpr double leaves_before_m = 12, is_back_after_m = 14;

/// A car overtakes only where the opposite lane lies beside its own all along,
/// the road is straight enough to be looked at, and everybody who comes, seen
/// or just out of sight at a little more than the limit, needs longer to where
/// it is back in its lane than the car does. Having begun it goes on while that
/// still holds without reserve; else it can stop before the body, or is
/// already beside it.
bool has_time_to_overtake(const world::route& way, const overtaking_car& car,
                          const blocked_stretch& body,
                          std::span<const oncoming_body> coming);

} // namespace sofof::planners
