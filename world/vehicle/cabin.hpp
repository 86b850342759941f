// The air in a car: a small thermal model, and what climate control does.
#pragma once

#include "base/options/option_visitor.hpp"

namespace sofof::world {

/// Two-node lumped model of a cabin: air and interior mass.
struct cabin_params {
  double air_capacity_jpk = 60e3;
  double mass_capacity_jpk = 300e3;
  double air_to_mass_wpk = 120;
  double air_to_outside_wpk = 60;
  double solar_gain_w = 400;
  double max_heating_w = 5000;
  double max_cooling_w = 4000;

  void visit_options(option_visitor& s) {
    s.field("air_capacity_jpk", air_capacity_jpk, {1e3, 1e7});
    s.field("mass_capacity_jpk", mass_capacity_jpk, {1e3, 1e8});
    s.field("air_to_mass_wpk", air_to_mass_wpk, {0, 1e4});
    s.field("air_to_outside_wpk", air_to_outside_wpk, {0, 1e4});
    s.field("solar_gain_w", solar_gain_w, {0, 2000});
    s.field("max_heating_w", max_heating_w, {0, 20e3});
    s.field("max_cooling_w", max_cooling_w, {0, 20e3});
  }
};

struct cabin_state {
  double air_c = 20;
  double mass_c = 20;
};

/// One step of implicit Euler: stable at any length, and heat is kept exactly
/// (losses counted at the step's end).
/// @param power_w  Heat into the air; negative cools.
/// @param dt_s     > 0, at most 10.
cabin_state step(const cabin_state& x, double power_w, double outside_c,
                 const cabin_params& cabin, double dt_s);

/// The constant heating or cooling power, within the limits, with the least
/// squares of air minus set point over the horizon; by the model above.
/// @param horizon_s  > 0.
/// @returns W; negative cools.
double climate_power_w(const cabin_state& x, double outside_c,
                       double set_point_c, double horizon_s,
                       const cabin_params& cabin);

} // namespace sofof::world
