// Where lanes meet: the stretches that two cars must not drive at once.
#pragma once

#include "world/roads/path.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace sofof::world {

/// Two lanes that meet without one following the other. The intervals are
/// arc lengths on the lanes where bodies on both could touch.
struct conflict {
  enum class kind {
    crossing, ///< The lanes cross.
    merge,    ///< They end in the same lane.
    diverge,  ///< They begin in the same lane; whoever is ahead leads.
  };
  std::size_t lane_a = 0, lane_b = 0; ///< Indices into the map's lanes.
  double from_a_m = 0, to_a_m = 0;
  double from_b_m = 0, to_b_m = 0;
  kind how = kind::crossing;
};

/// Centre lines that come closer than this meet, m: the bodies (1.89 m wide)
/// and half a metre between them. Lanes side by side are 3.5 m apart.
inline constexpr double meeting_distance_m = 2.4;

/// Added to both ends of a conflict's stretches, m.
inline constexpr double meeting_margin_m = 1;

/// Finds all conflicts by geometry; a lane and its successor have none.
/// @param paths  The smooth path of each lane.
/// @param next   Indices of each lane's successors.
/// @returns conflicts with lane_a < lane_b, in rising order of (lane_a,
/// lane_b, from_a_m).
std::vector<conflict>
find_conflicts(std::span<const path> paths,
               std::span<const std::vector<std::size_t>> next);

} // namespace sofof::world
