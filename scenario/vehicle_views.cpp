// Only vehicles with programs look for them.
#include "scenario/vehicle_views.hpp"

#include <algorithm>

namespace sofof::scenario {

seeing_client make_seeing_client(const scenario_definition& s,
                                 const messages::georeference_ptr& where) {
  seeing_client made;
  if (const auto* planning = planning_service(s))
    made.plans = planning->plans();
  if (std::ranges::none_of(s.services,
                           [](const auto& type) { return type->is_program(); }))
    return made;
  made.view =
      std::make_shared<actors::vehicle_view>(actors::vehicle_view::tells{
          where, world::vehicle_params{}, s.sensors, s.v2x.is_release_2()});
  if (made.plans)
    made.plans = actors::onlooking(made.plans, made.view);
  return made;
}

} // namespace sofof::scenario
