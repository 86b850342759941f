// SP: the edge server's side of offloading.
#pragma once

#include "channel/channel_draws.hpp"
#include "channel/load_meter.hpp"
#include "channel/provider_compute.hpp"
#include "messages/broadcast/decode_broadcast.hpp"
#include "messages/type_ids.hpp"
#include "offloading/service.hpp"
#include "policies/api/context.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace sofof::actors {

/// What a provider is made of.
struct provider_actor_setup {
  provider_id id = 0;
  point position; ///< m, east-north.
  polygon area;
  std::shared_ptr<const world::road_map> map; ///< For the policy; not null.
  /// Reads what vehicles tell everybody.
  std::function<messages::broadcast(const messages::its_pdu&, time_point now)>
      decode;
  std::vector<offloading::service> services; ///< With different names.
  std::unique_ptr<policies::central_policy> codm;
  messages::recorder_actor recorder;
  channel::provider_compute compute;
  std::shared_ptr<channel::load_meter> load; ///< Of its workers; may be null.
  random_stream seed{0, ""};
  std::uint32_t number = 0; ///< Of the provider, for its draws.
  bool virtual_time = true; ///< Model computing times.
  bool trace = false;       ///< Record each step.
  /// Of a provider that rides with a vehicle, as offloading::provider_setup has
  /// it; then `position` is where it rides off.
  std::optional<double> reach_m{};
};

/// Offers and runs services by the rules of offloading/provider. The listener
/// of each service is told all CAMs and CPMs and all that the provider's
/// sensors see. ITS messages that cannot be read are as if they had not come.
/// On exit it closes what still runs (shutdown).
messages::roadside_provider_actor
spawn_service_provider(caf::actor_system& sys, provider_actor_setup setup);

} // namespace sofof::actors
