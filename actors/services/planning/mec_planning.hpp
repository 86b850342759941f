// Planning at a provider: from what vehicles and its own sensors tell it.
#pragma once

#include "actors/services/planning/edge_perception.hpp"
#include "actors/services/planning/planning_world.hpp"
#include "offloading/service.hpp"

#include <memory>

namespace sofof::actors {

/// Takes the MCMs of one vehicle, which say where it is allowed to go, and,
/// when the provider takes over, which plan it follows. Where the vehicle is
/// it knows from its CAMs, and from the plans that it has sent; the others
/// from everybody's CAMs and CPMs and from its sensors. Gives an MCM that
/// suggests a plan, about it a `plan_report`; none until it knows what is round
/// the vehicle, and has a plan in comfort.
/// @param vehicle  For which it plans.
std::shared_ptr<offloading::service_function>
make_mec_planning(planning_world_ptr world,
                  offloading::provider_context provider, station_id vehicle,
                  std::shared_ptr<edge_perception> perceived);

} // namespace sofof::actors
