// Lanes and areas on Earth, as features of GeoJSON.
#pragma once

#include "experiments/convert/recorded_drive.hpp"

#include <span>
#include <string>

namespace sofof::experiments::convert {

/// @returns "[[longitude, latitude], ...]", degrees.
std::string coordinates_of(const messages::geo_frame& frame,
                           std::span<const point> points);

/// @returns features, joined by commas: a line for each lane, a polygon for
/// each house and for each provider's area, a point for each provider.
std::string scenery_features(const recorded_drive& drive);

/// @returns them as a whole.
std::string feature_collection(const std::string& features);

} // namespace sofof::experiments::convert
