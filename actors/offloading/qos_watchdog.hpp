// The QoS watchdog: reports when results come late or stop coming.
#pragma once

#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

namespace sofof::actors {

/// Watches one service of one vehicle by the rules of `offloading::watchdog`.
/// Once a session it sends `requester` a qos_violation: when an arrival was
/// later than the limit, or at the very moment when the gap is too long.
messages::watchdog_actor
spawn_qos_watchdog(caf::actor_system& sys, messages::qos_limits limits,
                   messages::onboard_requester_actor requester);

} // namespace sofof::actors
