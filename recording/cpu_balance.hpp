// Whether offloading pays in computing time, and what that is in energy: pure
// sums over shares of a core.
#pragma once

#include <optional>

namespace sofof::recording {

/// What one vehicle's computer does, percent of one core.
struct cpu_shares {
  double active = 0;   ///< c_TPLa: of the local function while it runs there,
  double inactive = 0; ///< c_TPLd: and while a provider runs it.
  /// c_SR: of the offloading itself, while the function runs in the vehicle,
  double requester = 0;
  /// and while a provider runs it. The paper has one for both.
  double requester_remote = 0;
};

/// @returns the mean share of a vehicle that never offloads, percent:
/// c_TPLa. Without offloading nobody has to keep a requester.
/// Source: Dehler & Buchholz 2025, c_without / t_total.
double share_without_offloading(const cpu_shares& c);

/// @param offloaded  t_d / t_total, 0 … 1.
/// @returns the mean share of a vehicle that offloads for a part of its time,
/// percent: t_a/t_total · (c_TPLa + c_SR) + t_d/t_total · (c_TPLd + c_SR), each
/// c_SR of its time.
/// Source: Dehler & Buchholz 2025, c_with / t_total.
double share_with_offloading(const cpu_shares& c, double offloaded);

/// @returns what a vehicle computes less while a provider plans, percent of a
/// core; negative where it computes more.
double saved_while_offloaded(const cpu_shares& c);

/// @returns the part of its time, t_d / t_total, that a vehicle must offload
/// for more than, so that it computes less than without. With one c_SR that is
/// c_SR / (c_TPLa − c_TPLd). Above 1 it never pays. nullopt when offloading
/// saves nothing while it lasts.
/// Source: Dehler & Buchholz 2025, the break-even inequality.
std::optional<double> break_even_share(const cpu_shares& c);

/// What computing costs in energy.
struct core_power {
  // A virtual CPU of a cloud's server, idle and busy. Source: the methodology
  // of Cloud Carbon Footprint, means of the processors of AWS, which are made
  // of SPECpower_ssj2008. A car's computer may differ by a factor.
  double idle_w = 0.74;
  double busy_w = 3.5;

  /// @returns joules per second of CPU time, W: what a core takes beyond being
  /// there, since it is there anyway.
  double more_when_busy_w() const { return busy_w - idle_w; }
};

/// @param share      Percent of one core.
/// @param speed_mps  Mean speed, m/s, > 0.
/// @returns the energy that computing takes, J/km.
double energy_j_per_km(double share, double speed_mps,
                       const core_power& power = {});

} // namespace sofof::recording
