// What a CPM of TS 103 324 says of the bodies that a vehicle perceives.
#include "messages/etsi/units.hpp"
#include "messages/v2x/cam_content.hpp"
#include "messages/v2x/perception.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sofof::messages {

namespace {

namespace ts = etsi::ts103324;
using std::chrono::milliseconds;

constexpr std::uint8_t own_sensor = 1;
constexpr std::uint8_t fused_here = 12;
constexpr std::uint16_t full_turn = 3600; // 0.1 °

/// The frame of a message: east and north of the sender's front.
struct frame {
  const geo_frame& earth;
  point at;

  point into(point map_axes) const { return earth.to_east_north(map_axes, at); }
  point out_of(point east_north) const {
    return earth.to_map_axes(east_north, at);
  }
  /// Of east, in the map.
  double heading_of(point east_north) const {
    const auto v = out_of(east_north);
    return std::atan2(v.y_m, v.x_m);
  }
};

/// A component of a vector, from an optional quantity.
std::optional<point> vector_of(const auto& quantity, const auto& x,
                               const auto& y) {
  const auto a = quantity.to_si(x.value), b = quantity.to_si(y.value);
  if (!a || !b)
    return std::nullopt;
  return point{*a, *b};
}

void describe(ts::perceived_object& told, const known_object& known,
              const frame& from, int later_ms) {
  const auto& what = known.what;
  told.id = static_cast<std::uint16_t>(known.id); // the last ones
  told.measured_at = static_cast<std::int16_t>(later_ms);
  const auto place = from.into(what.centre - from.at);
  told.position.x.value =
      wire<std::int32_t>(etsi::cpm_ts_distance_m, place.x_m);
  told.position.y.value =
      wire<std::int32_t>(etsi::cpm_ts_distance_m, place.y_m);
  const auto ahead = from.into(unit_vector(what.heading_rad));
  auto& velocity =
      told.velocity.emplace().value.emplace<etsi::cartesian_velocity>();
  velocity.x.value =
      wire<std::int16_t>(etsi::velocity_mps, what.speed_mps * ahead.x_m);
  velocity.y.value =
      wire<std::int16_t>(etsi::velocity_mps, what.speed_mps * ahead.y_m);
  auto& acceleration =
      told.acceleration.emplace().value.emplace<etsi::cartesian_acceleration>();
  acceleration.x.value =
      wire<std::int16_t>(etsi::accel_mps2, what.accel_mps2 * ahead.x_m);
  acceleration.y.value =
      wire<std::int16_t>(etsi::accel_mps2, what.accel_mps2 * ahead.y_m);
  told.angles.emplace().z.value = static_cast<std::uint16_t>(
      etsi::angle_to_wire(std::atan2(ahead.y_m, ahead.x_m)));
  told.x_dimension.emplace().value =
      wire<std::uint16_t>(etsi::cpm_ts_size_m, what.length_m);
  told.y_dimension.emplace().value =
      wire<std::uint16_t>(etsi::cpm_ts_size_m, what.width_m);
  auto& kind = told.classification.emplace();
  kind.resize(1);
  std::get<0>(kind[0].what.value) = etsi::passenger_car;
  kind[0].confidence = 101; // unavailable
}

ts::sensor_information describe(const world::sensor_params& can) {
  ts::sensor_information told;
  told.id = own_sensor;
  told.type = fused_here;
  etsi::radial_shape view;
  view.range = static_cast<std::uint16_t>(
      std::clamp(std::lround(10 * can.range_m), 0L, 4095L));
  const auto half =
      static_cast<std::uint16_t>(std::lround(5 * can.field_of_view_deg));
  view.horizontal_start =
      static_cast<std::uint16_t>((full_turn - half) % full_turn);
  view.horizontal_end = half;
  told.shape.emplace().value = view;
  told.shadowing = can.occlusion;
  return told;
}

/// Only what looks ahead as far to the left as to the right is understood.
void look_through(const ts::sensor_information& told, world::viewpoint& eye) {
  const auto* view = told.shape
                         ? std::get_if<etsi::radial_shape>(&told.shape->value)
                         : nullptr;
  if (!view || (view->horizontal_start + view->horizontal_end) % full_turn != 0)
    return;
  eye.range_m = 0.1 * view->range;
  eye.field_of_view_deg = 0.2 * view->horizontal_end;
}

std::optional<timed_object> decode(const ts::perceived_object& told,
                                   const frame& from, time_point reference) {
  const auto* velocity =
      told.velocity
          ? std::get_if<etsi::cartesian_velocity>(&told.velocity->value)
          : nullptr;
  if (!told.x_dimension || !told.y_dimension || !told.angles || !velocity
      || told.map_position)
    return std::nullopt;
  const auto length = etsi::cpm_ts_size_m.to_si(told.x_dimension->value);
  const auto width = etsi::cpm_ts_size_m.to_si(told.y_dimension->value);
  const auto yaw = etsi::angle_to_rad(told.angles->z.value);
  const auto speed = vector_of(etsi::velocity_mps, velocity->x, velocity->y);
  if (!length || !width || !yaw || !speed)
    return std::nullopt;
  world::perceived_object what;
  what.length_m = *length;
  what.width_m = *width;
  const point place{0.01 * told.position.x.value.value,
                    0.01 * told.position.y.value.value};
  const auto axis = unit_vector(*yaw);
  what.centre = from.at + from.out_of(place);
  what.heading_rad = from.heading_of(axis);
  what.speed_mps = dot(axis, *speed);
  if (const auto* x = told.acceleration
                          ? std::get_if<etsi::cartesian_acceleration>(
                              &told.acceleration->value)
                          : nullptr)
    if (const auto accel = vector_of(etsi::accel_mps2, x->x, x->y))
      what.accel_mps2 = dot(axis, *accel);
  return timed_object{reference + milliseconds{told.measured_at.value}, what,
                      told.id.value_or(0)};
}

} // namespace

ts::cpm make_cpm_ts103324(const perceived_scene& scene,
                          const world::vehicle_params& car,
                          const georeference& where) {
  const auto& own = scene.own;
  const auto place = where.frame.to_wgs84(
      scene.at_roadside ? own.position : front_of(own, car));
  ts::cpm message;
  message.header.station = own.station.value();
  const auto generated = where.clock.timestamp(own.at);
  auto& body = message.body;
  body.management.reference_time = static_cast<std::uint64_t>(generated);
  body.management.position = to_reference(place);
  const auto add = [&body]<class Container>(Container x) {
    body.containers.emplace_back().value = std::move(x);
  };
  if (!scene.at_roadside) {
    ts::originating_vehicle sender;
    sender.orientation.value = static_cast<std::uint16_t>(
        where.frame.to_etsi_heading(own.heading_rad, own.position));
    add(std::move(sender));
  }
  if (scene.sensor) {
    ts::sensor_information_container sensors;
    sensors.push_back(describe(*scene.sensor));
    add(std::move(sensors));
  }
  const auto at = where.frame.to_map(place);
  if (!at)
    return message;
  const frame from{where.frame, *at};
  const auto later_ms = static_cast<int>(std::clamp<std::int64_t>(
      where.clock.timestamp(scene.seen) - generated, -2048, 2047));
  ts::perceived_object_container seen;
  seen.number_of_objects =
      static_cast<std::uint8_t>(std::min<std::size_t>(scene.perceived, 255));
  seen.objects.resize(scene.objects.size());
  for (std::size_t i = 0; i < seen.objects.size(); ++i)
    describe(seen.objects[i], scene.objects[i], from, later_ms);
  add(std::move(seen));
  return message;
}

std::optional<object_list> read_cpm(const ts::cpm& message,
                                    const georeference& where) {
  const auto& management = message.body.management;
  const auto at = where.frame.to_map(to_geo(management.position));
  if (!at)
    return std::nullopt;
  const auto reference = where.clock.time(
      static_cast<std::int64_t>(management.reference_time.value));
  const frame from{where.frame, *at};
  std::vector<timed_object> objects;
  std::size_t perceived = 0;
  world::viewpoint eye{.at = *at};
  auto is_heading_known = false;
  for (const auto& container : message.body.containers) {
    if (const auto* seen =
            std::get_if<ts::perceived_object_container>(&container.value)) {
      perceived += seen->number_of_objects.value;
      for (const auto& told : seen->objects)
        if (const auto x = decode(told, from, reference))
          objects.push_back(*x);
    } else if (const auto* sender =
                   std::get_if<ts::originating_vehicle>(&container.value)) {
      const auto heading =
          where.frame.to_map_heading(sender->orientation.value, *at);
      is_heading_known = heading.has_value();
      eye.heading_rad = heading.value_or(0);
    } else if (const auto* sensors =
                   std::get_if<ts::sensor_information_container>(
                       &container.value)) {
      if (sensors->size() == 1)
        look_through(sensors->front(), eye);
    }
  }
  auto seen =
      brought_together(message.header.station.value, reference, objects);
  seen.perceived = perceived;
  if (is_heading_known)
    seen.eye = eye;
  return seen;
}

} // namespace sofof::messages
