// SP: the edge server's side of offloading.
#pragma once

#include "actors/offloading/service_type.hpp"
#include "channel/channel.hpp"
#include "channel/multi_server_queue.hpp"
#include "messages/type_ids.hpp"
#include "policies/api/context.hpp"

#include <caf/actor_system.hpp>

#include <memory>
#include <vector>

namespace sofof {

/// What a provider is made of.
struct provider_setup {
  provider_id boot = 0;
  point position; ///< m, east-north.
  polygon area;
  streets_ptr world;
  georeference_ptr where;              ///< Where that is on Earth.
  std::vector<service_type_ptr> kinds; ///< Offered.
  std::unique_ptr<central_policy> codm;
  recorder_actor recorder;
  std::shared_ptr<const channel_profile> profile; ///< Computing times.
  random_stream seed{0, ""};
  std::uint32_t number = 0;      ///< Of the provider, for its draws.
  bool virtual_time = true;      ///< Model computing times.
  bool crossings_granted = true; ///< As functions are told.
};

/// Offers and runs services by the rules of offloading/provider. The context of
/// each service hears of all CAMs and CPMs and of all that the provider's
/// sensors see. ITS messages that cannot be read are as if they had not come.
/// On exit it closes what still runs (shutdown).
roadside_provider_actor spawn_service_provider(caf::actor_system& sys,
                                               provider_setup setup);

} // namespace sofof
