// What a vehicle does whose distance has become less than the safe one.
#pragma once

#include "world/vehicle/trajectory.hpp"

namespace sofof::planners {

/// Makes a plan brake from its start on, until it stands, where it would go
/// faster; where it leads stays as it is. Where it brakes harder it still does.
/// Source: Shalev-Shwartz et al., arXiv 1708.06374, the proper response of
/// definition 4.
/// @param plan         Sound.
/// @param decel_mps2   > 0.
void respond_properly(world::trajectory& plan, double decel_mps2);

} // namespace sofof::planners
