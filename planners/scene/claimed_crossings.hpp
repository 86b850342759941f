// Where drives that others have claimed close the own way, and when.
#pragma once

#include "planners/scene/driving_scene.hpp"
#include "planners/scene/told_drive.hpp"
#include "world/roads/route.hpp"

#include <span>
#include <vector>

namespace sofof::planners {

/// @param way        The own route.
/// @param width_m    Of the own body, with what is to be kept.
/// @param stretches  Of the own way, where others cross.
/// @param out        Gets one entry for each drive and stretch in which bodies
///                   would touch.
void list_claimed(const world::route& way, double width_m, time_point now,
                  std::span<const way_stretch> stretches,
                  std::span<const told_drive> told,
                  std::vector<crossing_user>& out);

} // namespace sofof::planners
