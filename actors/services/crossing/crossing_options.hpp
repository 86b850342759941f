// Which crossing is conducted, and how.
#pragma once

#include "base/geometry.hpp"
#include "base/options/option_visitor.hpp"
#include "messages/protocol/motion.hpp"
#include "messages/protocol/payload.hpp"
#include "messages/v2x/georeference.hpp"
#include "planners/crossing/conductor.hpp"
#include "planners/scene/lane_network.hpp"
#include "world/roads/streets.hpp"
#include "world/vehicle/vehicle.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace sofof::actors {

/// Where crossings are conducted.
struct crossing_options {
  point centre;
  double radius_m = 100;

  void visit_options(option_visitor& s) {
    s.field("x_m", centre.x_m, {-1e6, 1e6});
    s.field("y_m", centre.y_m, {-1e6, 1e6});
    s.field("radius_m", radius_m, {10, 1000});
  }
};

/// What all who take part share.
struct crossing_world {
  world::streets_ptr streets;
  messages::georeference_ptr where;
  world::vehicle_params car{};
  crossing_options options;
  std::shared_ptr<const planners::lane_network> lanes;
};
using crossing_world_ptr = std::shared_ptr<const crossing_world>;

/// The vehicle asks for its part, here and now.
struct crossing_request {
  std::string way; ///< Name of the route.
  messages::cam own;
  double s_m = 0; ///< Rear axle on it, laps included.
};

void visit_fields(auto& v, crossing_request& x) {
  v("way", x.way);
  v("own", x.own);
  v("s_m", x.s_m);
}

} // namespace sofof::actors

template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::actors::crossing_request> =
        "crossing_request";
