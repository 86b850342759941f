// A car: moves, sends CAMs, follows the trajectories it is given.
#pragma once

#include "actors/simulation/driven_car.hpp"
#include "channel/vehicle_place.hpp"
#include "messages/type_ids.hpp"
#include "messages/v2x/georeference.hpp"
#include "messages/v2x/v2x_options.hpp"
#include "world/sensing/sensors.hpp"

#include <caf/actor_system.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace sofof::actors {

/// By which a provider hears vehicles while they are near enough.
struct antenna {
  point position; ///< m, east-north; of one that rides, where it rides off.
  double range_m = 0;
  /// The vehicle that it rides with, and where that is; nullopt: none.
  std::optional<station_id> carrier{};
  std::shared_ptr<const channel::vehicle_place> rides{};

  /// @returns whether it is near enough to a vehicle there, which is not the
  /// one that it rides with.
  bool hears(station_id station, point from) const {
    const auto here = rides ? rides->last() : std::optional{position};
    return carrier != station && here && distance_m(from, *here) <= range_m;
  }
};

/// What one vehicle is made of.
struct vehicle_setup {
  car_setup car;
  /// It is there so long after it was spawned, or later, when its place is
  /// free; zero: at once.
  duration appears_after{};
  /// The service that plans how it drives; null: none does.
  std::shared_ptr<const plan_client> plans;
  world::sensor_params sensor; ///< As its CPMs tell it.
  /// What it tells everybody; nothing if it is not connected.
  std::optional<messages::v2x_options> v2x;
  messages::georeference_ptr where; ///< Where the map is on Earth.
  /// Of all providers, shared by all vehicles; null: there are none.
  std::shared_ptr<const std::vector<antenna>> antennas;
  /// @returns the link to the provider of one of these, by its number. Asked
  /// for once, when the vehicle is in range for the first time.
  std::function<messages::link_actor(std::size_t)> connect;
  /// Is told where the vehicle is whenever the road is; null: nobody asks.
  std::shared_ptr<channel::vehicle_place> place;
  /// The provider that rides with it; null: none. It is told by wire where the
  /// vehicle is, what that sees and what it tells everybody, but is never asked
  /// for anything by it, and ends when the vehicle leaves the streets.
  messages::roadside_provider_actor rider;
  messages::air_actor air; ///< Null: other vehicles do not hear it.
  messages::road_actor road;
  messages::recorder_actor recorder;
  /// Makes the vehicle's requester.
  std::function<messages::onboard_requester_actor(
      const messages::vehicle_actor&)>
      spawn_requester;
};

/// A `driven_car` that tells the road where it is, its requester and everybody
/// near what it does, and asks the manager that it is given for plans whenever
/// it has perceived the others. At the end of an open route it leaves the
/// streets.
messages::vehicle_actor spawn_vehicle(caf::actor_system& sys,
                                      vehicle_setup setup);

} // namespace sofof::actors
