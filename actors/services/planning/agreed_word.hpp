// What a vehicle has agreed on at a crossing, as the provider that plans for it
// is told.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "planners/scene/driving_scene.hpp"
#include "planners/trajectory/trajectory_planner.hpp"

#include <optional>

namespace sofof::actors {

/// The drive that a vehicle has to keep to is the plan in an MCM of it whose
/// answer is "pending"; other plans are the one in use.
class agreed_word {
public:
  explicit agreed_word(planning_world_ptr world) : world_{std::move(world)} {}

  /// @returns whether the message has an agreed drive; it replaces the last.
  bool on_report(const messages::decoded_mcm& word);

  /// @param way  Of the vehicle.
  /// @returns what is left of the drive; nullopt: nothing was agreed.
  std::optional<planners::agreed_drive>
  drive(const planners::planning_input& from, const world::route_ptr& way,
        time_point now) const;

private:
  double line_ahead_m(const world::route_ptr& way, double front_m) const;

  planning_world_ptr world_;
  std::optional<messages::decoded_mcm> word_; // has a plan
};

} // namespace sofof::actors
