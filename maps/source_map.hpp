// A map of another format, as it is read: lanes and what was left out.
#pragma once

#include "base/geometry.hpp"
#include "world/roads/road_map.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sofof::maps {

/// A lane as its source draws it: a polyline with kinks.
struct source_lane {
  std::string name;          ///< As in the source.
  std::vector<point> centre; ///< m, in the map's frame; at least 2.
  double half_width_m = 1.6;
  double limit_mps = 13.89;
  std::vector<std::string> next{}; ///< Names of the lanes that follow.
  int rank = 0;
  bool inside = false; ///< Whether it lies in a junction.
  /// The edges of the source that are driven on it, in order: routes of
  /// SUMO are lists of these.
  std::vector<std::string> edges{};
};

/// A way through the source's network.
struct source_route {
  std::string name;
  std::vector<std::string> edges{};
};

/// One vehicle of a demand file.
struct departure {
  std::string vehicle;
  std::size_t route = 0; ///< Index into the routes.
  double at_s = 0;
};

/// How many of what was left out: "U-turns" → 12.
using tally = std::map<std::string, std::size_t>;

/// What of a map's origin is left out: places of a UTM zone are counted from
/// the equator to the north.
inline constexpr auto southern = "the place on earth, south of the equator";

/// All that is known of a map before its lanes are drawn smoothly.
struct source_map {
  std::string name;
  std::optional<world::geo_origin> origin;
  point middle; ///< Of the map's frame, in the source's, if that is another.
  std::vector<source_lane> lanes;
  std::vector<source_route> routes;
  std::vector<departure> departures;
  tally left_out;
};

} // namespace sofof::maps
