// How a vehicle asks a service for plans, and reads them.
#pragma once

#include "messages/protocol/payload.hpp"
#include "messages/protocol/service.hpp"
#include "planners/trajectory/trajectory_planner.hpp"
#include "world/roads/route.hpp"
#include "world/sensing/perception.hpp"

#include <memory>
#include <optional>

namespace sofof::actors {

/// A plan, and how it came about.
struct received_plan {
  std::shared_ptr<const world::trajectory> plan; ///< Not null.
  planners::plan_report report;
};

/// A service that plans how vehicles drive, as they see it. Without state: all
/// vehicles may share one.
class plan_client {
public:
  virtual ~plan_client() = default;

  /// @param from  Where the plan shall begin.
  /// @param seen  By the vehicle, and granted to it.
  /// @param own   Its motion as its CAMs tell it.
  /// @param crossing  What was agreed at one, of who agrees for it; or nothing.
  /// @returns the input of the service.
  virtual messages::payload ask(const world::route& way,
                                const planners::planning_input& from,
                                const world::perception& seen,
                                const messages::cam& own,
                                const messages::payload& crossing) const = 0;

  /// @returns nullopt for what is no plan.
  virtual std::optional<received_plan>
  read(const messages::service_result& result) const = 0;
};

} // namespace sofof::actors
