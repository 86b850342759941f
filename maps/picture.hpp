// A map as a picture.
#pragma once

#include "world/roads/sharp_bends.hpp"
#include "world/roads/streets.hpp"

#include <string>
#include <vector>

namespace sofof::maps {

/// Where a provider stands, and the corners of its area, m.
struct pictured_provider {
  std::string name;
  point at;
  std::vector<point> area;
};

/// What is drawn besides the streets.
struct picture_additions {
  std::vector<pictured_provider> providers;
  std::vector<world::sharp_bend> bends; ///< That no car can follow.
};

/// @returns an SVG file, in the colours of reports: lanes with their
/// directions, where they conflict, where routes begin, houses, providers'
/// areas, bends that are too sharp, and a scale. Names are shown where the
/// pointer is.
std::string draw(const world::streets& world, const picture_additions& more);

} // namespace sofof::maps
