// SR: the vehicle's side of offloading.
#pragma once

#include "channel/core_wait.hpp"
#include "channel/preemptive_core.hpp"
#include "messages/protocol/motion.hpp"
#include "messages/type_ids.hpp"
#include "offloading/service.hpp"
#include "policies/api/context.hpp"
#include "world/vehicle/cycle_cost.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace sofof::actors {

/// A service, and who asks it and uses its results.
struct client_service {
  offloading::service service;
  /// By default the vehicle itself.
  std::function<messages::client_actor(caf::actor_system&,
                                       const messages::vehicle_actor& vehicle)>
      spawn_client =
          [](caf::actor_system&, const messages::vehicle_actor& vehicle) {
            return messages::client_actor{vehicle};
          };
  channel::core_seat seat{}; ///< Of its own function, in virtual time.
};

/// What one vehicle's requester is made of.
struct requester_actor_setup {
  station_id station = 0;
  /// The route ahead, m, as decisions and requests need it.
  std::function<std::vector<point>(const messages::ego_state&)> path_ahead =
      [](const messages::ego_state&) { return std::vector<point>{}; };
  std::vector<client_service> services; ///< With different names.
  std::unique_ptr<policies::local_policy> lodm;
  messages::vehicle_actor vehicle;
  messages::recorder_actor recorder;
  random_stream noise{0, ""}; ///< Of this vehicle.
  bool virtual_time = true;   ///< Model run times instead of taking time.
  world::computer_options computer = {};
  channel::core_wait host{}; ///< What its own functions wait for a core.
  /// What is to come, where a run can tell; else null.
  std::shared_ptr<const policies::channel_oracle> future{};
  /// What results are like by place; null: nobody tells.
  std::shared_ptr<policies::quality_forecast> forecast{};
  bool record_margins = false; ///< Of results that are used.
  bool trace = false;          ///< Record each step.
};

/// Weighs offers, requests services, and owns the states of all services of
/// its vehicle, by the rules of `offloading::requester`; one state machine for
/// each service and provider:
///
///   local → requested → starting → remote → local
///
/// A service that runs at one provider goes on there until another one that it
/// was requested from gives first data (hand-over), or at both of them, if that
/// was decided.
///
/// It spawns a manager and a client for each service. When the last provider
/// that runs a service is lost, ends it or breaks its limits, the local service
/// is activated at the same time. On exit it closes what still runs (shutdown).
messages::onboard_requester_actor
spawn_service_requester(caf::actor_system& sys, requester_actor_setup setup);

} // namespace sofof::actors
