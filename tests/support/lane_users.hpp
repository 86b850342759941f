// Road users in lane order, for tests: who is ahead of whom.
#pragma once

#include "world/traffic/lane_order.hpp"
#include "world/traffic/road_user_state.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sofof::toy {

/// The nearest road user ahead.
struct leader {
  station_id station = 0;
  double rear_m = 0; ///< Its rear bumper, arc length on the follower's route.
  double speed_mps = 0;
  friend bool operator==(const leader&, const leader&) = default;
};

class lane_users {
public:
  explicit lane_users(const world::road_map& map)
      : all_{std::make_unique<const world::conflict_sides>(
          world::list_encounters(map))},
        order_{*all_} {}

  /// Sorts these into the lanes, instead of those before.
  void sort(std::span<const world::road_user> users) {
    drivers_.clear();
    for (const auto& u : users) {
      auto& way = ways_[u.on];
      if (!way)
        way = std::make_shared<const world::unrolled_route>(u.on, *all_);
      drivers_.emplace_back(u, way).leg = way->leg_at(u.s_m);
    }
    order_.sort(drivers_);
  }

  /// @returns whom `station` follows, if anybody; it must be known.
  std::optional<leader> ahead_of(station_id station) const {
    const auto self =
        std::ranges::find(drivers_, station, &world::road_user_state::station);
    const auto seen =
        order_.ahead_of(static_cast<std::size_t>(self - drivers_.begin()));
    if (!seen)
      return std::nullopt;
    const auto& other = drivers_[seen->who].known;
    return leader{other.station, seen->rear_m, other.speed_mps};
  }

private:
  std::unique_ptr<const world::conflict_sides> all_; // stays where it is
  world::lane_order order_;
  std::map<world::route_ptr, std::shared_ptr<const world::unrolled_route>>
      ways_;
  std::vector<world::road_user_state> drivers_;
};

} // namespace sofof::toy
