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
  bool trace = false;          ///< Record each step.
  bool asks_scene = false;     ///< Under which response time it is safe.
  world::computer_options computer{}; ///< The vehicle's.
};

/// Owns the local instance and the watchdog, and uses results by the rules of
/// `offloading::source_selector`. The local instance is fed always, so that it
/// can take over in any turn, and it is activated or deactivated in the turn in
/// which the source changes.
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
