// A drive as CommonRoad's kinematic single-track model has it.
#pragma once

#include "base/geometry.hpp"
#include "world/vehicle/vehicle.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sofof::experiments::judge {

/// Vehicle 2 of CommonRoad, a BMW 320i. Source: "CommonRoad: Vehicle Models"
/// (Althoff, Würsching; 2020a), table of the parameters of vehicle 2; the
/// wheelbase is 3.793293 ft + 4.667707 ft.
struct ks_vehicle {
  double length_m = 4.508, width_m = 1.610, wheelbase_m = 2.5789;
  double max_steer_rad = 1.066, max_steer_rate_radps = 0.4;
  double max_speed_mps = 50.8;
  double max_accel_mps2 = 11.5; ///< Of all directions together.
  /// From this speed on the engine gives `max_accel_mps2` · `switch_mps` / v.
  double switch_mps = 7.319;
};

/// One state of that model.
struct ks_state {
  int step = 0; ///< Time.
  point at;     ///< Of the middle of the body.
  double steer_rad = 0, speed_mps = 0, heading_rad = 0;

  oriented_box body() const;
};

/// A car of ours at one moment of a drive.
struct driven_moment {
  double t_s = 0;
  world::vehicle_state car;
};

/// From a car's rear axle to the middle of its body, m.
inline constexpr double axle_to_middle_m = 1.4675;

/// Lets the middle of our car's body move as the model has it: its heading is
/// the direction in which that moves.
/// @param drive   At even times from 0 on, at least two moments.
/// @param step_s  A multiple of the time between these, or more than it.
/// @param first   The step of the first state.
/// @returns states at all steps within the drive.
std::vector<ks_state> ks_states(std::span<const driven_moment> drive,
                                double step_s, int first);

/// @returns which limit of the vehicle some states do not keep, or where the
/// model, steered and driven evenly, comes more than 1 cm or 0.005 rad off the
/// next state, in a sentence; nullopt if nothing of this is so.
std::optional<std::string> broken_limit(std::span<const ks_state> states,
                                        double step_s);

} // namespace sofof::experiments::judge
