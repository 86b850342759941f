// Whether a car keeps to its road.
#pragma once

#include "world/roads/route.hpp"
#include "world/vehicle/vehicle.hpp"

namespace sofof::world {

/// @param s_m  Of the rear axle on its route, laps included, to within 2 m.
/// @returns whether both ends of the wheelbase, and half of the width beside
/// them, are within the lane or its opposite.
bool is_on_road(const route& way, double s_m, const vehicle_state& car,
                const vehicle_params& params);

} // namespace sofof::world
