// A station that sends providers what no honest one would.
#pragma once

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "base/time.hpp"
#include "messages/type_ids.hpp"
#include "messages/v2x/georeference.hpp"

#include <caf/actor_system.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace sofof::actors {

/// Whom it talks to, and how.
struct hostile_setup {
  std::vector<messages::provider_actor> providers; ///< At least one.
  duration every{}; ///< It says something to each so often, > 0.
  /// Cars that it makes up are between these corners, m.
  point from_m, to_m;
  messages::georeference_ptr where;
  random_stream noise;
  /// Counts what it says, and outlives it.
  std::shared_ptr<std::atomic<std::uint64_t>> said;
};

/// Sends in turn, at random: octets that are no message, CAMs of cars that are
/// not there, and such CAMs with octets changed or cut off. It never speaks in
/// the name of others, as certificates do not let it. Quits with the last of
/// the providers.
void spawn_hostile_station(caf::actor_system& sys, hostile_setup setup);

} // namespace sofof::actors
