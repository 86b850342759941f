// What vehicles say of their ways and drives, in MCMs.
#pragma once

#include "messages/v2x/mcm/mcm_content.hpp"
#include "planners/scene/told_drive.hpp"
#include "world/roads/route.hpp"
#include "world/roads/streets.hpp"
#include "world/vehicle/trajectory.hpp"
#include "world/vehicle/vehicle.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sofof::actors {

/// @returns where a vehicle may go: along its route, from its rear axle on, up
/// to where its front has to wait.
std::vector<point> authority(const world::route& way, double s_m,
                             std::optional<double> stop_at_m);

/// @param rear_m  How far bodies reach behind the point that drives, which MCMs
///                do not tell.
/// @returns the body in time that a planned trajectory is; empty for none. Of
/// who does not tell its size, the largest that there may be.
planners::claimed_drive drive_of(const messages::decoded_mcm& word,
                                 const messages::geo_frame& earth,
                                 double rear_m);

/// @returns what is left of a drive, as far as an MCM tells it: 30 s; empty if
/// nothing is.
world::trajectory told_rest(const world::trajectory& drive, time_point now);

/// @returns whether it claims that drive.
bool is_claim(const messages::decoded_mcm& word);

/// @param route  The way ahead of a vehicle that asks.
/// @returns why nobody can plan there who knows these streets, a short literal;
/// empty: somebody can.
std::string_view objection_to(std::span<const point> route,
                              const world::streets& known);

} // namespace sofof::actors
