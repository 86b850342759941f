// What an MCM says of a session: the name of its maneuver, and why it ends.
#pragma once

#include "messages/etsi/mcm.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"

namespace sofof::actors {

/// @returns the reason for ending a session, in the words of an MCM.
messages::etsi::termination_status status_of(messages::end_reason why);

/// @returns the name under which a session's maneuver is negotiated.
messages::maneuver_name name_of_maneuver(const messages::session_id& running);

} // namespace sofof::actors
