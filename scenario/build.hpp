// From a scenario to actors.
#pragma once

#include "messages/etsi/its_time.hpp"
#include "messages/type_ids.hpp"
#include "scenario/runtime.hpp"
#include "scenario/scenario.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sofof {

/// Everything that lives in a run, in the order in which it was spawned.
struct world_actors {
  recorder_actor recorder;
  road_actor road;
  std::vector<provider_actor> providers;
  std::vector<link_actor> links;
  std::vector<vehicle_actor> vehicles;
  caf::actor supervisor;
};

/// Spawns a scenario's actors. Each provider gets the boot id of its place in
/// the file, counting from 1; each vehicle a link to each provider.
/// @param s     Loaded, so that everything in it is valid.
/// @param sink  Takes all records.
/// @param clock  Tells the time of day of the run.
/// @param virtual_time  Model computing times instead of taking time.
/// @param on_loss  Called with a sentence when one of them dies.
world_actors build(caf::actor_system& sys, const scenario& s,
                   std::shared_ptr<record_sink> sink, etsi::its_clock clock,
                   bool virtual_time,
                   std::function<void(const std::string&)> on_loss = {});

/// Ends all actors, group by group, so that what still runs is closed on both
/// sides and recorded: the vehicles with their requesters first, the recorder
/// last.
void dismiss(const world_actors& actors, runtime& time);

} // namespace sofof
