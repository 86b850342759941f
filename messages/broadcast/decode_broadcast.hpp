// What a message of another station says.
#pragma once

#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/georeference.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "messages/v2x/perception.hpp"

#include <variant>

namespace sofof::messages {

/// A CAM, a CPM, an MCM of a vehicle, or nothing.
using broadcast = std::variant<std::monostate, cam, object_list, decoded_mcm>;

/// @param now  See read_cam, read_cpm.
/// @returns nothing for what cannot be decoded, does not tell what it has to,
/// or is of another kind.
broadcast decode(const its_pdu& message, const georeference& where,
                 time_point now);

} // namespace sofof::messages
