// The cabin's heat balance, stepped implicitly.
#include "world/vehicle/cabin.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::world {
namespace {

constexpr double prediction_step_s = 10;
constexpr double probe_w = 1000;

} // namespace

cabin_state step(const cabin_state& x, double power_w, double outside_c,
                 const cabin_params& cabin, double dt_s) {
  assert(dt_s > 0);
  // Implicit Euler: both balances hold at the step's end. The mass's,
  // mass' = mass + share (air' - mass), is put into the air's.
  const auto between = cabin.air_to_mass_wpk;
  const auto share =
      between * dt_s / (cabin.mass_capacity_jpk + between * dt_s);
  const auto to_mass = between * (1 - share);
  const auto out = cabin.air_to_outside_wpk;
  const auto heat =
      power_w + cabin.solar_gain_w + out * outside_c + to_mass * x.mass_c;
  cabin_state next;
  next.air_c = (cabin.air_capacity_jpk * x.air_c + dt_s * heat)
               / (cabin.air_capacity_jpk + dt_s * (out + to_mass));
  next.mass_c = x.mass_c + share * (next.air_c - x.mass_c);
  return next;
}

double climate_power_w(const cabin_state& x, double outside_c,
                       double set_point_c, double horizon_s,
                       const cabin_params& cabin) {
  assert(horizon_s > 0);
  // The model is linear: air(power) = air(0) + gain · power at every moment;
  // the power with the least squares of air - set point is wanted.
  const auto steps = std::max(1.0, std::ceil(horizon_s / prediction_step_s));
  const auto dt_s = horizon_s / steps;
  auto idle = x, warmed = x;
  double wanted = 0, norm = 0;
  for (auto i = 0.0; i < steps; ++i) {
    idle = step(idle, 0, outside_c, cabin, dt_s);
    warmed = step(warmed, probe_w, outside_c, cabin, dt_s);
    const auto gain = warmed.air_c - idle.air_c;
    wanted += gain * (set_point_c - idle.air_c);
    norm += gain * gain;
  }
  return std::clamp(probe_w * wanted / norm, -cabin.max_cooling_w,
                    cabin.max_heating_w);
}

} // namespace sofof::world
