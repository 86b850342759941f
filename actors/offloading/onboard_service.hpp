// What a vehicle has of a service at any time, whoever runs it.
#pragma once

#include "actors/offloading/service_requester.hpp"
#include "offloading/requester.hpp"

#include <functional>
#include <vector>

namespace sofof {

struct onboard_service {
  client_actor client;
  requester_manager_actor manager; ///< Has the instance on board, too.
};

/// @returns what that kind makes its parts of in a vehicle.
service_setup onboard_setup(const requester_setup& vehicle,
                            const service_type& kind,
                            std::function<time_point()> clock);

/// @returns what the rules of the requester have to know of it.
/// @param here  What `onboard_setup` returned for this vehicle and kind.
offloading::requested_service requested(const requester_setup& vehicle,
                                        const service_type_ptr& kind,
                                        const service_setup& here);

/// Spawns client and manager, which ends with its local instance. The
/// requester is to be linked to both, but for a client that is the vehicle.
/// @param here  Likewise.
onboard_service spawn_onboard_service(caf::actor_system& sys,
                                      const requester_setup& vehicle,
                                      const service_type_ptr& kind,
                                      onboard_requester_actor requester,
                                      const service_setup& here);

/// @returns what the rules of a vehicle's requester are made of.
offloading::requester_setup
rules_of(requester_setup vehicle,
         std::vector<offloading::requested_service> services);

} // namespace sofof
