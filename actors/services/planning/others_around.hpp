// What a provider's planner knows of the others round one vehicle, and by whom.
#pragma once

#include "actors/services/planning/edge_perception.hpp"
#include "actors/services/planning/plan_cycle.hpp"
#include "actors/services/planning/scene_words.hpp"
#include "messages/protocol/its_pdu.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace sofof::actors {

/// Who plans at a provider knows the others by
/// * what the provider hears and sees, if planning is one service there;
/// * in a chain: the scene that comes with the vehicle's word, or, if none
///   does, the environment model that runs beside it for this vehicle.
class others_around {
public:
  others_around(planning_world_ptr world, provider_id provider,
                station_id vehicle, std::shared_ptr<edge_perception> perceived)
      : world_{std::move(world)}, provider_{provider}, vehicle_{vehicle},
        perceived_{std::move(perceived)} {}

  /// Takes what comes with an input of the service.
  /// @returns the vehicle's word; null if there is none.
  std::shared_ptr<const messages::its_pdu>
  on_input(const messages::payload& what, time_point now);

  /// @returns whether they are known well enough to drive by.
  bool are_known() const;

  /// What is known of them now is what the next plan is made by.
  void look();

  /// Plans among them. `from.others` says of stopping and of what was agreed.
  planners::plan_report plan(time_point now, planners::planning_input from,
                             plan_cycle& cycle);

private:
  planning_world_ptr world_;
  provider_id provider_;
  station_id vehicle_;
  std::shared_ptr<edge_perception> perceived_;
  std::shared_ptr<const messages::its_pdus> heard_;
  std::optional<decoded_scene> told_;
  std::shared_ptr<others_source> beside_;
  // From a look to the plan: of many vehicles, few are planned for at a time.
  std::vector<planners::track> tracks_;
  std::vector<planners::told_drive> drives_;
};

} // namespace sofof::actors
