// From a scenario to actors.
#pragma once

#include "actors/remote/provider_proxy.hpp"
#include "channel/load_meter.hpp"
#include "channel/octet_ledger.hpp"
#include "messages/etsi/its_time.hpp"
#include "messages/type_ids.hpp"
#include "scenario/forecasts.hpp"
#include "scenario/runtime.hpp"
#include "scenario/scenario.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sofof::scenario {

/// Which part of a scenario lives in this process: without changes, all of it.
struct process_share {
  /// Whether this process drives a vehicle.
  std::function<bool(station_id)> drives = [](station_id) { return true; };
  /// Whether it runs a provider, by its place in the file, counting from 0.
  std::function<bool(std::size_t)> provides = [](std::size_t) { return true; };
  /// When the process started; tells boots of one provider apart.
  std::uint64_t start = 0;

  /// A provider that another process runs.
  struct remote_provider {
    std::size_t place; ///< In the file, counting from 0.
    std::function<actors::provider_outbox(const messages::recorder_actor&)>
        spawn_provider_connection;
  };
  std::vector<remote_provider> remotes;
  /// Tells other processes what its vehicles tell each other; may be empty.
  std::function<void(const messages::its_pdu&)> tell_others{};
  /// Whether vehicles of other processes come to its providers.
  bool serves_others = false;
  /// Called with what its providers hear, and when, on any thread; may be
  /// empty.
  std::function<void(const messages::cam&, time_point)> on_heard;
};

/// @returns whether this process runs a provider: what rides with a vehicle
/// lives where that does.
/// @param number  Its place in the scenario, counting from 0.
bool lives_here(const scenario_definition& s, const process_share& here,
                std::size_t number);

/// What is measured of a provider and of the radio cell round it. One that has
/// started again goes on with the same.
struct provider_load {
  std::string name;
  double worker_w = 0; ///< What a busy worker takes beyond an idle one, W.
  std::shared_ptr<channel::load_meter> workers, cell_up, cell_down;
  std::shared_ptr<channel::octet_ledger> octets_up, octets_down;
};

/// Everything that lives in a run, but for what vehicles make themselves: their
/// requesters, and links to providers of this process.
struct world_actors {
  messages::recorder_actor recorder;
  messages::road_actor road;
  messages::air_actor air;
  std::vector<messages::provider_actor> providers;
  std::vector<actors::provider_outbox> connections;
  std::vector<messages::link_actor> proxies; ///< To the far ends of these.
  std::vector<messages::vehicle_actor> vehicles;
  std::vector<caf::actor> crash_injectors;
  caf::actor supervisor;
  bool has_peers = false;           ///< On other hosts.
  std::vector<provider_load> loads; ///< Of the providers that live here.
  std::shared_ptr<place_forecasts> forecasts; ///< Of the vehicles.
};

/// Spawns the actors of a scenario, or of a part of it. Each provider gets the
/// id of its place in the file, counting from 1. A provider that dies and
/// starts again is two, the second with an id of its own.
/// @param s     Loaded, so that everything in it is valid.
/// @param sink  Takes all records.
/// @param clock  Tells the time of day of the run.
/// @param virtual_time  Model computing times instead of taking time.
/// @param here  What of it.
/// @param on_loss  Called with a sentence when one of them dies.
world_actors build(caf::actor_system& sys, const scenario_definition& s,
                   std::shared_ptr<messages::record_sink> sink,
                   messages::etsi::its_clock clock, bool virtual_time,
                   std::function<void(const std::string&)> on_loss = {},
                   const process_share& here = {});

/// Ends all actors, group by group, so that what still runs is closed on both
/// sides and recorded: the vehicles with their requesters first, the recorder
/// last.
void dismiss(const world_actors& actors, runtime& time);

} // namespace sofof::scenario
