// What an MCM says of a session: the name of its maneuver, and why it ends.
#pragma once

#include "messages/etsi/mcm.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"

namespace sofof {

/// @returns the reason for ending a session, in the words of an MCM.
etsi::termination_status status_of(end_reason why);

/// @returns the name under which a session's maneuver is negotiated.
maneuver_name name_of_maneuver(const session_id& running);

} // namespace sofof
