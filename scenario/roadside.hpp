// Sensors at the roadside, as the actors of a scenario have them.
#pragma once

#include "actors/simulation/road.hpp"
#include "scenario/build.hpp"
#include "scenario/scenario.hpp"
#include "scenario/vehicle_connections.hpp"

#include <vector>

namespace sofof::scenario {

/// @param noise  Of all of them.
/// @returns those of providers; none where the cars drive in other processes:
/// they would tell of an empty road, and speak against every car.
std::vector<actors::roadside_sensor>
sensors_beside(const random_stream& noise,
               const std::vector<provider_cell>& cells,
               const process_share& here);

/// @returns sensors of one kind, with the errors of the worse of two: of a
/// track nobody remembers who saw it.
world::sensor_params noisier(world::sensor_params one,
                             const world::sensor_params& other);

} // namespace sofof::scenario
