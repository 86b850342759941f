// The actors of one service in a vehicle, and what the rules know of it.
#pragma once

#include "actors/offloading/service_requester.hpp"
#include "offloading/requester.hpp"

#include <memory>
#include <vector>

namespace sofof {

struct service_actors {
  client_actor client;
  requester_manager_actor manager; ///< Has the instance on board, too.
};

/// Spawns client and manager, which ends with its local instance. The
/// requester is to be linked to both, but for a client that is the vehicle.
/// @param own  The service in this vehicle.
service_actors
spawn_service_actors(caf::actor_system& sys, const requester_setup& vehicle,
                     const client_service& what,
                     const std::shared_ptr<offloading::vehicle_service>& own,
                     onboard_requester_actor requester);

/// @returns what the rules of the requester have to know of a service.
/// @param own  Likewise.
offloading::requested_service
requested(const requester_setup& vehicle, const offloading::service& what,
          std::shared_ptr<offloading::vehicle_service> own);

/// @returns what the rules of a vehicle's requester are made of.
offloading::requester_setup
rules_of(requester_setup vehicle,
         std::vector<offloading::requested_service> services);

} // namespace sofof
