// What a car's body sweeps whose rear axle follows a line.
#pragma once

#include "base/geometry.hpp"

#include <vector>

namespace sofof::maps {

/// @returns how wide a lane has to be, from its middle, for a car that follows
/// its centre line: both axles and 0.4 m beside them.
double needed_half_width_m(const std::vector<point>& centre);

} // namespace sofof::maps
