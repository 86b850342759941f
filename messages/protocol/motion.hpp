// Inside one vehicle and its world: how it moves, and what sensors see of it.
#pragma once

#include "messages/protocol/inspect.hpp"
#include "messages/protocol/service.hpp"
#include "world/sensing/perception.hpp"
#include "world/sensing/viewpoint.hpp"
#include "world/vehicle/vehicle.hpp"

#include <cstdint>
#include <vector>

namespace sofof {

/// Where a vehicle really is; the road derives from it what others see.
struct motion_report {
  station_id station = 0;
  double s_m = 0; ///< Rear axle on its route, laps included.
  vehicle_state state;
};

/// What a vehicle tells its own requester all the time.
struct ego_state {
  cam own;
  double s_m = 0; ///< Rear axle on its route, laps included.
};

/// What a sensor at the roadside sees, for the provider that it belongs to.
struct roadside_detections {
  time_point at;
  std::vector<perceived_object> objects; ///< As `scene::seen_by` gives them.
  std::uint32_t sensor = 0;              ///< Which of its sensors it is.
  viewpoint from{};
};

/// Which source the results of a service come from, from now on.
struct source_change {
  service_name kind;
  bool remote = false;
};

template <class Inspector>
bool inspect(Inspector& f, vehicle_state& x) {
  return f.object(x).fields(
      f.field("at", x.at), f.field("heading_rad", x.heading_rad),
      f.field("speed_mps", x.speed_mps), f.field("accel_mps2", x.accel_mps2),
      f.field("steer_rad", x.steer_rad));
}

template <class Inspector>
bool inspect(Inspector& f, motion_report& x) {
  return f.object(x).fields(f.field("station", x.station),
                            f.field("s_m", x.s_m), f.field("state", x.state));
}

template <class Inspector>
bool inspect(Inspector& f, ego_state& x) {
  return f.object(x).fields(f.field("own", x.own), f.field("s_m", x.s_m));
}

template <class Inspector>
bool inspect(Inspector& f, source_change& x) {
  return f.object(x).fields(f.field("kind", x.kind),
                            f.field("remote", x.remote));
}

template <class Inspector>
bool inspect(Inspector& f, perceived_object& x) {
  return f.object(x).fields(
      f.field("centre", x.centre), f.field("heading_rad", x.heading_rad),
      f.field("speed_mps", x.speed_mps), f.field("accel_mps2", x.accel_mps2),
      f.field("length_m", x.length_m), f.field("width_m", x.width_m));
}

template <class Inspector>
bool inspect(Inspector& f, perception& x) {
  return f.object(x).fields(f.field("at", x.at),
                            f.field("stop_at_m", x.stop_at_m),
                            f.field("objects", x.objects));
}

template <class Inspector>
bool inspect(Inspector& f, viewpoint& x) {
  return f.object(x).fields(f.field("at", x.at),
                            f.field("heading_rad", x.heading_rad),
                            f.field("range_m", x.range_m),
                            f.field("field_of_view_deg", x.field_of_view_deg));
}

template <class Inspector>
bool inspect(Inspector& f, roadside_detections& x) {
  return f.object(x).fields(f.field("at", x.at), f.field("objects", x.objects),
                            f.field("sensor", x.sensor),
                            f.field("from", x.from));
}

} // namespace sofof
