// What the programs of vehicles see.
#pragma once

#include "actors/services/programs/vehicle_view.hpp"
#include "scenario/scenario.hpp"

#include <memory>

namespace sofof::scenario {

/// What the programs of one vehicle see, and who asks for its plans.
struct seeing_client {
  std::shared_ptr<actors::vehicle_view> view; ///< Null: it has no programs.
  std::shared_ptr<const actors::plan_client> plans; ///< Null: none plans.
};

/// @returns them for one vehicle.
seeing_client make_seeing_client(const scenario_definition& s,
                                 const messages::georeference_ptr& where);

} // namespace sofof::scenario
