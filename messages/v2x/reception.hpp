// What a message of another station says.
#pragma once

#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/datum.hpp"
#include "messages/v2x/perception.hpp"

#include <variant>

namespace sofof {

/// A CAM, a CPM, or neither.
using broadcast_word = std::variant<std::monostate, cam, sighting>;

/// @param now  See read_cam, read_cpm.
/// @returns nothing for what cannot be decoded, does not tell what it has to,
/// or is of another kind.
broadcast_word understand(const its_pdu& message, const datum& where,
                          time_point now);

} // namespace sofof
