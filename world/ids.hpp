// Names of things: who talks, and what it is about.
#pragma once

#include <cstdint>

namespace sofof {

/// A connected vehicle, as in ETSI ITS (StationID).
using station_id = std::uint32_t;

/// A provider process since its start; a restarted one has a new id.
using boot_id = std::uint64_t;

} // namespace sofof
