// What computing and sending take at both ends, and what offloading saves by
// it: pure sums of watts and times. docs/energy.md has the sources together.
#pragma once

#include "world/vehicle/cycle_cost.hpp"

#include <optional>

namespace sofof::world {

/// What a vehicle's computer and radio take.
struct vehicle_power {
  double computing_w = 0;   ///< A core that is busy, beyond one that is not.
  double resting_share = 0; ///< Of that, a function that rests: see below.
  double sending_j = 0;     ///< An octet that is sent,
  double receiving_j = 0;   ///< and one that is received.
};

/// @returns that of a computer and its radio: κ f³ or what the user says, and
/// p b / r for an octet.
vehicle_power power_of(const computer_options& computer);

/// What one worker of a provider takes.
struct server_power {
  double busy_w = 0; ///< While it is busy, beyond being there,
  double idle_w = 0; ///< and for being there.
};

/// What was done for a service, or is expected to be.
struct energy_use {
  double computing_s = 0; ///< By the vehicle's own function.
  /// That it would have computed in the time for which it rested.
  double resting_s = 0;
  double octets_up = 0; ///< By the vehicle's radio,
  double octets_down = 0;
  double framework_j = 0; ///< Of the vehicle, for what it got.
  double served_s = 0;    ///< By workers of a provider.
};

/// What that takes, J; in a second, W.
struct energy_parts {
  double computing_j = 0, resting_j = 0, framework_j = 0;
  double sending_j = 0, receiving_j = 0;
  double server_busy_j = 0; ///< Beyond being there.
  double server_idle_j = 0; ///< Of being there, for the time that was used.

  energy_parts& operator+=(const energy_parts& x);

  /// @returns that of the vehicle's computer,
  double vehicle_j() const { return computing_j + resting_j + framework_j; }
  /// of its radio,
  double radio_j() const { return sending_j + receiving_j; }
  /// of the provider,
  double server_j() const { return server_busy_j + server_idle_j; }
  /// and all of it.
  double j() const { return vehicle_j() + radio_j() + server_j(); }
};

/// Linear in all of it:
/// * the vehicle: busy time by power, and of a function that rests the share
///   of what it would have taken. A function that is deactivated goes on
///   listening;
/// * the radio: octets;
/// * the server: busy time by power beyond being there (Fan, Weber & Barroso,
///   ISCA 2007), and for the same time being there.
energy_parts energy_of(const energy_use& use, const vehicle_power& vehicle,
                       const server_power& server);

/// @param home_s  What the vehicle would have computed itself.
/// @param spent   What was done instead took, at the powers that count.
/// @returns the power of the vehicle's computer at which that saves exactly
/// nothing, W: below, it costs more than it saves. nullopt if the vehicle
/// computes no less by it: then it never pays.
std::optional<double> break_even_w(double home_s, const energy_use& use,
                                   const energy_parts& spent,
                                   double resting_share);

} // namespace sofof::world
