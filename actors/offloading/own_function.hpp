// What a requester is made of, and when its vehicle's own functions run.
#pragma once

#include "actors/offloading/service_requester.hpp"
#include "channel/preemptive_core.hpp"
#include "offloading/requester.hpp"
#include "offloading/service_cycle.hpp"

#include <functional>
#include <vector>

namespace sofof::actors {

/// @returns for which vehicle its services are made.
offloading::vehicle_context context_of(const requester_actor_setup& vehicle,
                                       std::function<time_point()> clock);

/// @param clock  The time, where it is real.
/// @returns the cycle of the vehicle's own function of a service. In virtual
/// time it takes a drawn run time, of the core that it shares, if it does.
offloading::cycle_setup own_function(const requester_actor_setup& vehicle,
                                     const offloading::onboard_service& service,
                                     std::function<time_point()> clock,
                                     const channel::core_seat& seat = {});

/// @returns what the rules of a vehicle's requester are made of.
offloading::requester_setup
rules_of(requester_actor_setup vehicle,
         std::vector<offloading::onboard_service> services);

} // namespace sofof::actors
