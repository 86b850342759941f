// The streets and all that moves on them, as sensors would show it.
#pragma once

#include "messages/type_ids.hpp"
#include "world/streets.hpp"
#include "world/vehicle.hpp"

#include <caf/actor_system.hpp>

#include <map>

namespace sofof {

/// Which way each station goes.
using station_routes = std::map<station_id, route_ptr>;

/// Collects where vehicles are, and tells each of them every
/// protocol::sensor_period what it perceives; records collisions, each pair
/// once as long as it touches.
/// @param grants_crossings  As `traffic` takes it.
road_actor spawn_road(caf::actor_system& sys, streets_ptr world,
                      station_routes ways, vehicle_params car,
                      recorder_actor recorder, bool grants_crossings = true);

} // namespace sofof
