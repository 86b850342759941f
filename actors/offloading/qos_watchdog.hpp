// The QoS watchdog: barks when results come late or stop coming.
#pragma once

#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

namespace sofof::actors {

/// Watches one kind of service in one vehicle. It barks once per running
/// service, to `requester`, with a qos_violation: when an arrival was later
/// than the limit, or at the very moment when the gap is too long. A gap in
/// which results came that were of no use is `implausible`.
messages::watchdog_actor
spawn_qos_watchdog(caf::actor_system& sys, messages::qos_limits limits,
                   messages::onboard_requester_actor requester);

} // namespace sofof::actors
