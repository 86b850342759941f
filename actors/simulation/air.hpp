// The air between vehicles.
#pragma once

#include "base/random.hpp"
#include "channel/channel_profile.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <memory>

namespace sofof::actors {

/// How vehicles hear each other.
struct air_setup {
  std::shared_ptr<const channel::channel_profile> channel; ///< Not null.
  random_stream noise{0, ""};
  double range_m = 300;
  /// Tells other processes what vehicles of this one say; empty: there are
  /// none.
  std::function<void(const messages::its_pdu&)> tell_others{};
};

/// Carries what one vehicle tells to all that are near it, to each with its own
/// delay and loss, in order. Who has died is forgotten. Words of stations that
/// do not hear by it, of other programs, come at once.
messages::air_actor spawn_air(caf::actor_system& sys, air_setup setup);

} // namespace sofof::actors
