// What others tell of their drives, as parts of the scene.
#pragma once

#include "planners/scene/crossing_predictor.hpp"
#include "planners/scene/driving_scene.hpp"
#include "planners/scene/told_drive.hpp"

#include <optional>
#include <span>

namespace sofof::planners {

/// Finds the bodies of those who tell how they drive, as sensors know no names:
/// nearest to where they said to be, within 4 m. Marks those who take part:
/// they have claimed a drive, and are not behind it by more than 1.5 m and by
/// more than 0.3 s, or they have not and the own car has agreed with them.
void find_those_who_tell(time_point now, std::span<const told_drive> told,
                         bool has_agreed, std::span<other_body> others);

/// Adds where drives that were claimed close the own way, but for those on the
/// own way itself: these follow or lead.
/// @param front_m  Of the own bumper, arc length.
/// @param half_m   What the own body takes on either side.
/// @param out      Stays in the order of `from_m`.
void add_claimed(time_point now, const world::route& way, double front_m,
                 double half_m, std::span<const way_stretch> keep_free,
                 std::span<const told_drive> told,
                 std::vector<crossing_user>& out);

/// Lists where the rear of the lead will be, as it tells, unless it is
/// elsewhere by more than 4 m already.
/// @param out  Rising; empty if it tells nothing.
void list_lead(time_point now, const world::route& way,
               const std::optional<lead_vehicle>& lead, double half_m,
               std::span<const told_drive> told, std::vector<way_moment>& out);

} // namespace sofof::planners
