// A car: moves, sends CAMs, follows the trajectories it is given.
#pragma once

#include "messages/type_ids.hpp"
#include "messages/v2x/georeference.hpp"
#include "messages/v2x/v2x_options.hpp"
#include "world/roads/road_map.hpp"
#include "world/sensing/sensors.hpp"
#include "world/vehicle/vehicle.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace sofof {

/// A provider that hears this vehicle while it is near enough.
struct antenna {
  link_actor link;
  point position; ///< Of the provider, m, east-north.
  double range_m = 0;
};

/// What one vehicle is made of.
struct vehicle_setup {
  station_id station = 0;
  route_ptr way;
  double start_s_m = 0;       ///< Where it starts on its route,
  double start_speed_mps = 0; ///< and how fast,
  duration appears_after{};   ///< so long after it was spawned, or later, when
                              ///< its place is free; zero: at once.
  vehicle_params car;
  sensor_params sensor; ///< As its CPMs tell it.
  /// What it tells everybody; nothing if it is not connected.
  std::optional<v2x_options> v2x;
  georeference_ptr where;  ///< Where the map is on Earth.
  duration fresh_limit{};  ///< Plans older than this are not fresh.
  duration track_period{}; ///< Between two track records; zero: none.
  std::vector<antenna> antennas;
  road_actor road;
  recorder_actor recorder;
  /// Makes the vehicle's requester.
  std::function<onboard_requester_actor(const vehicle_actor&)> spawn_requester;
};

/// Steps the car at protocol::control_period along the newest trajectory. It
/// begins with a plan to keep its speed, and when a plan is about to end
/// without a successor it makes a safe stop of its own: it never is without a
/// plan. At the end of an open route it leaves the streets.
vehicle_actor spawn_vehicle(caf::actor_system& sys, vehicle_setup setup);

} // namespace sofof
