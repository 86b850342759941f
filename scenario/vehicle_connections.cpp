// What connects vehicles to providers.
#include "scenario/vehicle_connections.hpp"

#include "actors/runtime/supervisor.hpp"
#include "actors/simulation/network_link.hpp"

#include <fmt/format.h>

#include <cassert>
#include <utility>

namespace sofof::scenario {

messages::link_actor vehicle_connections::connect(
    station_id station, std::size_t to, bool lives,
    std::shared_ptr<const channel::vehicle_place> place) const {
  assert(to < cells_.size());
  const auto& at = cells_[to];
  const channel::channel_draws draws{at.channel, noise_, station, at.place,
                                     at.options->radio};
  auto link = actors::spawn_network_link(
      sys_, at.provider,
      {{{draws, channel::direction::up, at.cell_up}, at.octets_up},
       {{draws, channel::direction::down, at.cell_down}, at.octets_down},
       std::nullopt,
       station,
       start_,
       std::move(place)});
  if (supervisor_ && lives && !at.may_die())
    actors::watch(supervisor_, caf::actor_cast<caf::actor>(link),
                  fmt::format("a link of vehicle {}", station));
  return link;
}

} // namespace sofof::scenario
