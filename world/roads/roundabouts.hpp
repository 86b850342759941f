// Which lanes make roundabouts, and how many vehicles find a place on each.
#pragma once

#include "world/roads/road_map.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sofof::world {

/// Rings of lanes that are too short to be a way round a block of streets.
class roundabouts {
public:
  static constexpr double longest_m = 200;
  /// From one front to the next, of those that stand.
  static constexpr double place_m = 8.6;

  explicit roundabouts(const road_map& map);

  std::size_t count() const { return places_.size(); }

  /// @returns the roundabout that a lane is part of; `count()` if there is
  /// none.
  std::size_t of(std::size_t lane) const { return of_[lane]; }

  /// @returns how many may be on it before it could fill up so that nobody
  /// moves any more: half of those that find a place, at least one.
  std::size_t most(std::size_t which) const { return places_[which]; }

private:
  std::vector<std::size_t> of_;     // of each lane
  std::vector<std::size_t> places_; // of each roundabout
};

} // namespace sofof::world
