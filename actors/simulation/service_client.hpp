// Who asks a service and uses what it gives: an actor, so that CAF is for those
// who spawn or make one, and not for all who read a service's options.
#pragma once

#include "messages/type_ids.hpp"
#include "planners/speed/route_profile.hpp"

#include <caf/actor_system.hpp>

#include <cstdint>
#include <memory>

namespace sofof::actors {

class vehicle_view; // actors/services/programs/vehicle_view.hpp

/// Where a client is spawned.
struct client_place {
  caf::actor_system& system;
  const messages::vehicle_actor& vehicle; ///< That it belongs to.
  station_id station = 0;
  planners::route_profile_ptr road{}; ///< Of its route; null: it has none.
  messages::recorder_actor recorder{};
  std::uint32_t place = 0; ///< Of the service in its chain, the first being 0.
  /// For programs; null where there are none.
  std::shared_ptr<vehicle_view> view{};
};

/// What a service's `spawn_client` has spawned.
struct service_client {
  messages::client_actor actor;
};

} // namespace sofof::actors
