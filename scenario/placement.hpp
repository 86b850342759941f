// Where the vehicles of a scenario start.
#pragma once

#include "scenario/scenario.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::scenario {

/// A vehicle before the run: its rear axle stands at `start_s_m` on its way.
struct placed_vehicle {
  station_id station = 0;
  std::size_t fleet = 0; ///< Index into the scenario's fleets.
  world::route_ptr way;
  double start_s_m = 0; ///< On a closed route in [0, length).
  duration appears{};   ///< When; zero: it is there from the start on.
  double left_m = 0;    ///< Beside its way,
  double turn_rad = 0;  ///< and turned from it; both to the left.

  /// @returns where it starts.
  oriented_box body() const;

  /// Whether it stands before the start or beyond the end of an open route.
  bool off_its_way() const {
    return start_s_m < 0 || start_s_m >= way->length_m();
  }
};

/// At least this between two vehicles that start one behind the other, m.
inline constexpr double min_start_gap_m = 3;

/// @param name  A fleet's: of one route, or a beginning and `*`, which stands
///              for all routes that begin so, in the order of the map.
/// @returns none for an unknown name.
std::vector<world::route_ptr> find_routes(const world::streets& world,
                                          std::string_view name);

/// Places all vehicles, fleet by fleet, in the order of their stations. Those
/// of a fleet that share a route are
/// * "equal": at even distances, from `start_m` once round a closed route, or
///   from `start_m` towards the end of an open one;
/// * "convoy": `spacing_m` apart, the first at `start_m`, each next one behind.
/// @param all  Loaded: its routes are in its world.
std::vector<placed_vehicle> place_vehicles(const scenario_definition& all);

/// @returns indices of two vehicles, there from the start on, of which one
/// stands on the other, or less than `min_start_gap_m` before or behind it;
/// nullopt if there are none.
std::optional<std::pair<std::size_t, std::size_t>>
find_too_near(std::span<const placed_vehicle> vehicles);

} // namespace sofof::scenario
