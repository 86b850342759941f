// Service management, on both sides: feeds a service, forwards its results.
#pragma once

#include "actors/offloading/service_instance.hpp"
#include "messages/type_ids.hpp"
#include "offloading/service.hpp"

#include <caf/actor_system.hpp>

#include <memory>

namespace sofof::actors {

/// Service management in the vehicle, for one service.
struct requester_manager_setup {
  station_id station = 0;
  offloading::onboard_service service;
  offloading::cycle_setup local; ///< Of the vehicle's own function.
  messages::client_actor client;
  messages::onboard_requester_actor requester;
  messages::recorder_actor recorder;
  bool record_margins = false; ///< With the cycles, those of used results.
};

/// Owns the local instance, activates it, and feeds it always, so that it can
/// jump in at any moment. Results of a remote service are used from the first
/// one that comes in time on: then the local instance is deactivated in the
/// same turn, the watchdog armed and the requester told. Results that come
/// too late, twice or out of order are not used; those that are not understood
/// are as if they had not come; one that is implausible ends its episode in the
/// turn in which it comes (`qos_breach::implausible`). While several providers
/// run the service, the first result of each planning cycle is used, if the
/// plan in use may be followed by it; a provider that has not been in time for
/// a second is given up (`qos_violation::others_hold`).
messages::requester_manager_actor
spawn_requester_manager(caf::actor_system& sys, requester_manager_setup setup);

/// Service management at the provider, for one accepted service.
struct provider_manager_setup {
  offloading::cycle_setup cycle;
  messages::requester_actor requester;
  messages::provider_actor provider;
  messages::recorder_actor recorder;
};

/// Configures the instance, activates it at the first input, and sends its
/// results to `requester`. Finalises the instance and quits at service_end;
/// quits (user_shutdown) when no input has come within protocol::start_timeout.
/// Does not outlive `provider`.
messages::provider_manager_actor
spawn_provider_manager(caf::actor_system& sys, provider_manager_setup setup);

} // namespace sofof::actors
