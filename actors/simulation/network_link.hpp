// The air between one vehicle and one provider.
#pragma once

#include "base/ids.hpp"
#include "channel/link_direction.hpp"
#include "channel/link_faults.hpp"
#include "channel/octet_ledger.hpp"
#include "channel/vehicle_place.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <memory>
#include <optional>

namespace sofof::actors {

/// One direction of a link.
struct link_way {
  channel::link_direction air;
  /// Counts all that is sent, if there is one.
  std::shared_ptr<channel::octet_ledger> octets = nullptr;
};

/// How a link carries what it is given.
struct link_setup {
  link_way up;
  link_way down;
  std::optional<channel::link_faults> faults; ///< For tests.
  station_id station = 0;  ///< The vehicle, by which disturbances are counted.
  time_point run_begins{}; ///< Outages are counted from here.
  /// Where the vehicle is; null: nobody tells, so that no area counts.
  std::shared_ptr<const channel::vehicle_place> place{};
};

/// A proxy that looks like the far end to both sides: it delays and loses
/// messages after the channel model, and hands itself out in place of every
/// handle that crosses it. In a distributed run the remote handle takes its
/// place. Quits when the provider does, so the requester sees its peer lost;
/// dies with the requester, so the provider sees the same.
messages::link_actor spawn_network_link(caf::actor_system& sys,
                                        messages::provider_actor far,
                                        link_setup setup);

} // namespace sofof::actors
