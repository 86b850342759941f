// A process of vehicles on the other side of a broker.
#pragma once

#include "actors/broker/provider_side.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace sofof::actors {

/// Stands for the vehicles of one process. Their hello comes from an envelope.
using process_actor = messages::vehicle_endpoint_actor::extend<
    messages::reacts_to<messages::peer_hello>>;

/// A process of vehicles, known by its link.
struct vehicle_process {
  process_actor stands_for_it;
  messages::provider_endpoint_actor endpoint; ///< Null before it is let in.
  station_id sender = 0; ///< Whose station it asked as, and
  std::string user;      ///< as whom; all its envelopes are of this user.
  /// It was let in with these; null before.
  std::shared_ptr<const std::set<station_id>> stations;

  /// @returns whether an envelope in its name may be for this station.
  bool is_of(station_id x) const {
    return x == sender || (stations && stations->contains(x));
  }
};

/// What the processes of a provider have in common. Any thread may call its
/// functions.
struct provider_side::shared {
  shared(caf::actor_system& s, provider_side_setup with)
      : sys{s}, setup{std::move(with)} {}

  caf::actor_system& sys;
  const provider_side_setup setup;
  std::mutex mutex;                                  // of the following
  std::map<std::int64_t, vehicle_process> processes; // by link
  std::map<station_id, std::int64_t> links;

  std::optional<vehicle_process> find(std::int64_t link) {
    const std::lock_guard lock{mutex};
    const auto at = processes.find(link);
    return at == processes.end() ? std::nullopt : std::optional{at->second};
  }

  std::optional<vehicle_process> find(station_id station) {
    const std::lock_guard lock{mutex};
    const auto at = links.find(station);
    return at == links.end() ? std::nullopt
                             : std::optional{processes.at(at->second)};
  }

  void let_in(std::int64_t link, const messages::peer_hello& hello,
              const messages::provider_endpoint_actor& endpoint) {
    const std::lock_guard lock{mutex};
    auto& process = processes.at(link);
    process.endpoint = endpoint;
    process.stations = std::make_shared<const std::set<station_id>>(
        hello.stations.begin(), hello.stations.end());
    for (const auto station : hello.stations)
      links.insert_or_assign(station, link);
  }

  /// @returns how many of this user have not been let in yet; with the lock.
  std::size_t waiting_of(const std::string& user) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(processes, [&](const auto& x) {
          return !x.second.endpoint && x.second.user == user;
        }));
  }

  void forget(std::int64_t link) {
    const std::lock_guard lock{mutex};
    std::erase_if(links, [=](const auto& x) { return x.second == link; });
    processes.erase(link);
  }
};

/// Spawns what stands for a process that asks to connect.
/// @param sender  Whose station it asks as.
process_actor spawn_process(std::shared_ptr<provider_side::shared> shared,
                            std::int64_t link, station_id sender,
                            const wire::connect_request& connect_request);

} // namespace sofof::actors
