// Whether heating or cooling that another computer asks for may be done.
#pragma once

#include "base/objection.hpp"
#include "world/vehicle/cabin.hpp"

#include <optional>

namespace sofof::planners {

/// What a vehicle knows about its cabin.
struct judged_climate {
  world::cabin_state cabin;
  double outside_c = 0;
  double set_point_c = 0;
  double horizon_s = 60;
};

/// Judges a power by what the vehicle's own control would do now. A provider
/// has its input later, so that it may differ by 20 % of what the cabin can do.
/// @param power_w  Negative cools.
/// @returns `range` for what the cabin cannot do, `comfort` for what is too far
/// from the own power; nullopt for a power that may be used.
std::optional<objection> judge_climate(double power_w, const judged_climate& x,
                                       const world::cabin_params& params);

/// @returns how much farther from the own power it might be, W: the margin of
/// `comfort`.
double climate_margin_w(double power_w, const judged_climate& x,
                        const world::cabin_params& params);

} // namespace sofof::planners
