// The figures of one vehicle's drive: of its plans, and of its ride.
#pragma once

#include "messages/protocol/record.hpp"
#include "planners/trajectory/trajectory_planner.hpp"
#include "world/vehicle/ride_comfort.hpp"
#include "world/vehicle/trip.hpp"

#include <optional>

namespace sofof::actors {

/// Told of every plan and every step, it measures both.
class drive_figures {
public:
  /// The vehicle stands, or drives already: on a plan of its own to go on so.
  drive_figures(station_id station, const world::vehicle_params& car,
                double start_speed_mps = 0)
      : station_{station}, stops_{start_speed_mps <= 0}, ride_{
                                                             car.wheelbase_m,
                                                             start_speed_mps} {}

  /// The plan of a service takes over.
  /// @param in_use   The plan until now.
  /// @param next     Sound.
  /// @param report   How `next` came about.
  /// @param running  Who made `next`; counter 0 is the vehicle itself.
  /// @returns the jump, if `in_use` is from another source.
  std::optional<messages::plan_switch_record>
  on_plan(const world::trajectory& in_use, const world::trajectory& next,
          const planners::plan_report& report,
          const messages::session_id& running, time_point now);

  /// A plan of the vehicle's own to stop takes over. It is a safe stop unless
  /// the vehicle stops already, or has not set off.
  void stop_safely();

  /// @param x  The car after a step of protocol::control_period.
  void on_step(const world::vehicle_state& x);

  /// @returns the figures since the last call.
  messages::drive_record flush();

  const world::stop_meter& stops() const { return stood_; }

private:
  station_id station_;
  // None: a plan of its own is in use.
  std::optional<messages::session_id> source_;
  bool stops_;             // by a plan of its own, or has not set off
  bool emergency_ = false; // so is the plan in use
  world::plan_figures plans_;
  world::ride_comfort ride_;
  world::stop_meter stood_;
};

} // namespace sofof::actors
