// The cabin of a car: what it asks of climate control, and what it does then.
#pragma once

#include "base/options/option_visitor.hpp"
#include "messages/protocol/payload.hpp"
#include "messages/type_ids.hpp"
#include "world/vehicle/cabin.hpp"

#include <caf/actor_system.hpp>

#include <string_view>

namespace sofof::actors {

/// Which power makes this cabin comfortable?
struct climate_request {
  double air_c = 0;
  double mass_c = 0;
  double outside_c = 0;
  double set_point_c = 0;
};

void visit_fields(auto& v, climate_request& x) {
  v("air_c", x.air_c);
  v("mass_c", x.mass_c);
  v("outside_c", x.outside_c);
  v("set_point_c", x.set_point_c);
}

/// This one.
struct climate_power {
  double power_w = 0; ///< Negative cools.
};

void visit_fields(auto& v, climate_power& x) {
  v("power_w", x.power_w);
}

/// The weather, what is wanted, and the cabin itself.
struct climate_options {
  double outside_c = 5;
  double set_point_c = 21;
  double horizon_s = 60;
  world::cabin_params cabin;

  void visit_options(option_visitor& s) {
    s.field("outside_c", outside_c, {-60, 60});
    s.field("set_point_c", set_point_c, {10, 30});
    s.field("horizon_s", horizon_s, {1, 3600});
    s.table("cabin", [this](option_visitor& t) { cabin.visit_options(t); });
  }
};

/// Asks once a period, and is warmed with whatever power came last.
messages::client_actor spawn_cabin(caf::actor_system& sys,
                                   const climate_options& options,
                                   duration period);

} // namespace sofof::actors

template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::actors::climate_request> =
        "climate_ask";
template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::actors::climate_power> =
        "climate_power";
