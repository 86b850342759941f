// What vehicles say of their drives at a crossing, in MCMs.
#pragma once

#include "messages/v2x/mcm/mcm_content.hpp"
#include "planners/scene/told_drive.hpp"
#include "world/vehicle/trajectory.hpp"
#include "world/vehicle/vehicle.hpp"

namespace sofof::actors {

/// @returns the body in time that a planned trajectory is; empty for none.
planners::claimed_drive drive_of(const messages::decoded_mcm& word,
                                 const messages::geo_frame& earth,
                                 const world::vehicle_params& car);

/// @returns what is left of a drive, as far as an MCM tells it: 20 s; empty if
/// nothing is.
world::trajectory told_rest(const world::trajectory& drive, time_point now);

/// @returns whether it claims that drive.
bool is_claim(const messages::decoded_mcm& word);

} // namespace sofof::actors
