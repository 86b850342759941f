// What connects vehicles to providers.
#pragma once

#include "actors/simulation/vehicle.hpp"
#include "base/random.hpp"
#include "channel/channel_profile.hpp"
#include "channel/octet_ledger.hpp"
#include "channel/shared_server_queue.hpp"
#include "channel/vehicle_place.hpp"
#include "scenario/provider_options.hpp"

#include <caf/actor_system.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace sofof::scenario {

/// A provider, from its start to its end, and the radio cell round it.
struct provider_cell {
  std::uint32_t place; // in the file
  messages::roadside_provider_actor provider;
  const provider_options* options;
  std::shared_ptr<const channel::channel_profile> channel;

  bool may_die() const { return options->fails_at.has_value(); }

  std::shared_ptr<channel::shared_server_queue> cell_up;
  std::shared_ptr<channel::shared_server_queue> cell_down;
  std::shared_ptr<channel::octet_ledger> octets_up;
  std::shared_ptr<channel::octet_ledger> octets_down;
};

/// Makes a vehicle's link to a provider of this process, and has it watched
/// while both are to live. Called by vehicles, each in a thread of its own.
class vehicle_connections {
public:
  /// @param noise       Of the network.
  /// @param start       Of the run.
  /// @param cells       Their options outlive this.
  /// @param supervisor  Null: nobody watches.
  vehicle_connections(caf::actor_system& sys, random_stream noise,
                      time_point start, std::vector<provider_cell> cells,
                      caf::actor supervisor)
      : sys_{sys}, noise_{noise}, start_{start}, cells_{std::move(cells)},
        supervisor_{std::move(supervisor)} {}

  const std::vector<provider_cell>& cells() const { return cells_; }

  /// @param to     Number of the cell.
  /// @param lives  Whether the vehicle's computer does to the end.
  /// @param place  Where the vehicle is; null: nobody tells.
  messages::link_actor
  connect(station_id station, std::size_t to, bool lives,
          std::shared_ptr<const channel::vehicle_place> place = {}) const;

private:
  caf::actor_system& sys_;
  random_stream noise_;
  time_point start_;
  std::vector<provider_cell> cells_;
  caf::actor supervisor_;
};

} // namespace sofof::scenario
