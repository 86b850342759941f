// How smooth a ride is, measured in the car.
#pragma once

#include "base/protocol.hpp"
#include "world/vehicle/plan_comfort.hpp"
#include "world/vehicle/vehicle.hpp"

#include <array>
#include <cstdint>

namespace sofof::world {

/// What was driven, and what it felt like.
struct ride_figures {
  double distance_m = 0;
  /// Lateral acceleration and jerk are not taken in an emergency.
  motion_extremes extremes;
  std::uint64_t hard_brakes = 0; ///< How often one began.
  /// ∫ (a² + (1 s · j)²) dt, m²/s³; a longitudinal acceleration, j jerk.
  double comfort_cost_m2ps3 = 0;

  void add(const ride_figures& x);
};

/// Looks at a car after each of its steps. Jerk is the difference of
/// acceleration over `jerk_window`, taken at every step.
class ride_comfort {
public:
  static constexpr duration jerk_window = std::chrono::milliseconds{50};
  /// So long after an emergency its aftermath is not taken either.
  static constexpr duration aftermath = std::chrono::seconds{1};
  /// Braking beyond this is hard.
  static constexpr double hard_mps2 = -3;

  /// @param speed_mps  At the beginning; the car neither brakes nor speeds up.
  explicit ride_comfort(double wheelbase_m, double speed_mps = 0)
      : wheelbase_m_{wheelbase_m}, speed_mps_{speed_mps} {
    window_.fill({speed_mps, 0});
  }

  /// @param x          After a step of protocol::control_period.
  /// @param emergency  Whether it follows an emergency plan or a safe stop.
  void add(const vehicle_state& x, bool emergency);

  /// @returns the figures since the last call.
  ride_figures flush();

private:
  struct motion {
    double speed_mps = 0;
    double accel_mps2 = 0;
  };

  static constexpr auto window_steps =
      static_cast<std::size_t>(jerk_window / protocol::control_period);

  double wheelbase_m_;
  ride_figures sum_;
  std::array<motion, window_steps> window_{}; // the oldest is next_
  std::size_t next_ = 0;
  double speed_mps_;
  bool brakes_hard_ = false;
  duration unsettled_{}; // still, after an emergency
};

} // namespace sofof::world
