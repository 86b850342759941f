// A provider's plans for one vehicle, as MCMs suggest them.
#pragma once

#include "base/ids.hpp"
#include "messages/protocol/payload.hpp"
#include "messages/v2x/georeference.hpp"
#include "world/vehicle/trajectory.hpp"

#include <cstdint>
#include <utility>

namespace sofof::actors {

/// Numbers what it suggests to one vehicle, and keeps its room.
class suggestion_writer {
public:
  suggestion_writer(messages::georeference_ptr where, station_id from,
                    station_id to)
      : where_{std::move(where)}, from_{from}, to_{to} {}

  /// @param session  By whose counter the maneuver is named.
  /// @param place    Where the provider is, m, east-north.
  /// @returns the message, encoded; empty if none can say this plan.
  messages::payload write(const world::trajectory& plan, std::uint32_t session,
                          point place);

private:
  messages::georeference_ptr where_;
  station_id from_;
  station_id to_;
  std::uint16_t update_ = 0;
};

} // namespace sofof::actors
