// What stands for a provider that is reached over a broker.
#pragma once

#include "actors/broker/vehicle_side.hpp"

#include <caf/actor_control_block.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::actors {

/// What stands for a provider.
using brokered_provider_actor =
    messages::acceptor_actor::extend_with<messages::handshake_actor>::
        extend_with<messages::provider_endpoint_actor>::extend<
            // The provider's answers: a challenge, a welcome and its station,
            // or a refusal.
            messages::reacts_to<std::uint32_t, std::uint64_t, std::string>,
            messages::reacts_to<messages::peer_welcome, station_id::rep>,
            messages::reacts_to<std::string, bool>>;

/// A proxy that is connected.
struct connected_proxy {
  std::string provider;
  caf::weak_actor_ptr proxy;
  messages::vehicle_endpoint_actor endpoint; ///< Null before the hello.
};

/// What the proxies of a process have in common. Any thread may call its
/// functions.
struct vehicle_side::shared {
  shared(caf::actor_system& s, vehicle_side_setup with)
      : sys{s}, setup{std::move(with)} {}

  caf::actor_system& sys;
  const vehicle_side_setup setup;
  std::mutex mutex; // of the following
  std::map<std::int64_t, connected_proxy> proxies;
  std::map<std::pair<station_id, std::byte>, std::vector<std::byte>> latest;

  /// Sends a CAM, CPM or MCM that is for everybody, if it is not the one of
  /// this kind that was sent last.
  void tell(station_id from, const messages::its_pdu& message) {
    if (message.octets.size() < 2)
      return;
    {
      const std::lock_guard lock{mutex};
      auto& last = latest[{from, message.octets[1]}];
      if (last == message.octets)
        return;
      last = message.octets;
    }
    setup.send(
        {.user = setup.user, .from = from, .what = wire::broadcast{message}});
  }

  std::optional<connected_proxy> find(std::int64_t link) {
    const std::lock_guard lock{mutex};
    const auto at = proxies.find(link);
    return at == proxies.end() ? std::nullopt : std::optional{at->second};
  }
};

/// Spawns what stands for the provider of this name, known by this link.
brokered_provider_actor
spawn_brokered_provider(std::shared_ptr<vehicle_side::shared> shared,
                        std::int64_t link, std::string provider);

} // namespace sofof::actors
