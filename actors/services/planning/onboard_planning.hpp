// Planning in the vehicle: from what it sees itself.
#pragma once

#include "actors/offloading/service_type.hpp"
#include "actors/services/planning/known_roads.hpp"
#include "actors/services/planning/planner_options.hpp"

#include <memory>

namespace sofof {

/// Takes a `plan_request`; gives a `trajectory`, about it a `plan_report`.
std::shared_ptr<service_function> make_onboard_planning(service_setup setup,
                                                        planner_options options,
                                                        known_roads_ptr roads);

} // namespace sofof
