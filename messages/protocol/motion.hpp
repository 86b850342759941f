// Inside one vehicle and its world: how it moves, and what sensors see of it.
#pragma once

#include "messages/protocol/inspect.hpp"
#include "messages/protocol/service.hpp"
#include "world/sensing/perception.hpp"
#include "world/sensing/viewpoint.hpp"
#include "world/vehicle/vehicle.hpp"

#include <cstdint>
#include <vector>

namespace sofof::messages {

/// Where a vehicle really is; the road derives from it what others see.
struct motion_report {
  station_id station = 0;
  double s_m = 0; ///< Rear axle on its route, laps included.
  world::vehicle_state state;
};

void visit_fields(auto& v, motion_report& x) {
  v("station", x.station);
  v("s_m", x.s_m);
  v("state", x.state);
}

/// What a vehicle tells its own requester all the time.
struct ego_state {
  cam own;
  double s_m = 0; ///< Rear axle on its route, laps included.
};

void visit_fields(auto& v, ego_state& x) {
  v("own", x.own);
  v("s_m", x.s_m);
}

/// What a sensor at the roadside sees, for the provider that it belongs to.
struct roadside_detections {
  time_point at;
  /// As `scene::seen_by` gives them.
  std::vector<world::perceived_object> objects;
  std::uint32_t sensor = 0; ///< Which of its sensors it is.
  world::viewpoint from{};
};

void visit_fields(auto& v, roadside_detections& x) {
  v("at", x.at);
  v("objects", x.objects);
  v("sensor", x.sensor);
  v("from", x.from);
}

/// Which source the results of a service come from, from now on.
struct source_change {
  service_name service;
  bool remote = false;
};

void visit_fields(auto& v, source_change& x) {
  v("service", x.service);
  v("remote", x.remote);
}

} // namespace sofof::messages
