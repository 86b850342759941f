// The streets and all that moves on them, and what sensors see of it.
#pragma once

#include "base/random.hpp"
#include "messages/type_ids.hpp"
#include "world/roads/streets.hpp"
#include "world/sensing/sensors.hpp"
#include "world/traffic/scripted_body.hpp"
#include "world/vehicle/vehicle.hpp"

#include <caf/actor_system.hpp>

#include <map>
#include <vector>

namespace sofof::actors {

/// Which way each station goes.
using station_routes = std::map<station_id, world::route_ptr>;

/// A provider's sensor at the roadside.
struct roadside_sensor {
  messages::roadside_provider_actor provider;
  world::sensor is;
};

/// What the road is made of.
struct road_setup {
  world::streets_ptr world;
  station_routes ways;
  world::vehicle_params car; ///< Every vehicle's.
  /// Of every vehicle, in the middle of its body.
  world::sensor_params sensors;
  random_stream noise{0, ""};          ///< Of the vehicles' sensors.
  std::vector<roadside_sensor> beside; ///< Sensors of providers.
  std::vector<oriented_box> obstacles; ///< Stand on the road. The k-th
                                       ///< collides as `obstacle_id(k)`.
  messages::recorder_actor recorder;
  bool grants_crossings = true; ///< As `traffic` takes it.
  /// Move by themselves; their times count from when the road is made.
  std::vector<world::scripted_body> scripted{};
};

/// Collects where vehicles are. Every protocol::sensor_period it tells each of
/// them what it perceives, and providers what their sensors see, each sensor
/// by a message of its own. It records collisions, each pair once as long as
/// it touches, and near misses of vehicles, each encounter once.
messages::road_actor spawn_road(caf::actor_system& sys, road_setup setup);

} // namespace sofof::actors
