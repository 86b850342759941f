// Planning in the vehicle: from what it sees itself.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "offloading/service.hpp"

#include <memory>

namespace sofof::actors {

/// Takes a `plan_request`; gives a `trajectory`, about it a `plan_report`.
std::shared_ptr<offloading::service_function>
make_onboard_planning(planning_world_ptr world,
                      offloading::vehicle_context vehicle);

} // namespace sofof::actors
