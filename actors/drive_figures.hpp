// The figures of one vehicle's drive: of its plans, and of its ride.
#pragma once

#include "messages/record.hpp"
#include "world/ride_meter.hpp"

#include <optional>

namespace sofof {

/// Told of every plan and every step, it measures both.
class drive_figures {
public:
  /// The vehicle stands, with a plan of its own to stay there.
  drive_figures(station_id station, const vehicle_params& car)
      : station_{station}, ride_{car.wheelbase_m} {}

  /// The plan of a service takes over.
  /// @param in_use   The plan until now.
  /// @param next     Sound.
  /// @param firm     It brakes firmer than comfort allows.
  /// @param running  Who made `next`; counter 0 is the vehicle itself.
  /// @returns the jump, if `in_use` is from another source.
  std::optional<plan_switch_record> take(const trajectory& in_use,
                                         const trajectory& next, bool firm,
                                         const running_service& running,
                                         time_point now);

  /// A plan of the vehicle's own takes over. It is a safe stop if it replaces
  /// the plan of a service.
  void stop_safely();

  /// @param x  The car after a step of protocol::control_period.
  void take(const vehicle_state& x) { ride_.take(x, emergency_); }

  /// @returns the figures since the last call.
  drive_record flush();

private:
  station_id station_;
  std::optional<running_service> source_; // none: a plan of its own is in use
  bool emergency_ = false;                // so is the plan in use
  plan_figures plans_;
  ride_meter ride_;
};

} // namespace sofof
