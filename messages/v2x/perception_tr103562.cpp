// What a CPM of TR 103 562 says of the bodies that a vehicle perceives.
#include "messages/etsi/units.hpp"
#include "messages/v2x/cam_content.hpp"
#include "messages/v2x/object_list.hpp"
#include "messages/v2x/perception.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sofof::messages {

namespace {

namespace tr = etsi::tr103562;
using std::chrono::milliseconds;

constexpr std::uint8_t the_sensor = 1;
constexpr std::uint8_t sensor_fusion = 8;
constexpr std::uint8_t car_class = 3;
constexpr std::uint16_t whole_circle = 3600; // 0.1 °
/// A vector of the map in a frame that heads like `axis`, and back.
point into(point axis, point v) {
  return {dot(axis, v), axis.x_m * v.y_m - axis.y_m * v.x_m};
}
point out_of(point axis, point v) {
  return v.x_m * axis + v.y_m * point{-axis.y_m, axis.x_m};
}

/// The frame of a message: where the sender's front is and where it heads.
struct sender_frame {
  point at;
  double heading_rad = 0;
  point axis = unit_vector(heading_rad);
};

void describe(tr::perceived_object& told, const known_object& known,
              const sender_frame& from, int age_ms) {
  const auto& what = known.what;
  told.id = static_cast<std::uint8_t>(known.id); // the last ones
  told.time_of_measurement = static_cast<std::int16_t>(age_ms);
  const auto place = into(from.axis, what.centre - from.at);
  told.x_distance.value =
      wire<std::int32_t>(etsi::cpm_tr_distance_m, place.x_m);
  told.y_distance.value =
      wire<std::int32_t>(etsi::cpm_tr_distance_m, place.y_m);
  const auto ahead = into(from.axis, unit_vector(what.heading_rad));
  told.x_speed.value =
      wire<std::int16_t>(etsi::velocity_mps, what.speed_mps * ahead.x_m);
  told.y_speed.value =
      wire<std::int16_t>(etsi::velocity_mps, what.speed_mps * ahead.y_m);
  told.x_acceleration.emplace().value =
      wire<std::int16_t>(etsi::accel_mps2, what.accel_mps2 * ahead.x_m);
  told.y_acceleration.emplace().value =
      wire<std::int16_t>(etsi::accel_mps2, what.accel_mps2 * ahead.y_m);
  told.yaw.emplace().value = static_cast<std::uint16_t>(
      etsi::angle_to_wire(what.heading_rad - from.heading_rad));
  told.planar_dimension_1.emplace().value =
      wire<std::uint16_t>(etsi::cpm_tr_size_m, what.length_m);
  told.planar_dimension_2.emplace().value =
      wire<std::uint16_t>(etsi::cpm_tr_size_m, what.width_m);
  auto& kind = told.classification.emplace();
  kind.resize(1);
  kind[0].confidence = 0;
  std::get<0>(kind[0].what.value).type = {car_class};
}

tr::sensor_information describe(const world::sensor_params& can,
                                const world::vehicle_params& car) {
  tr::sensor_information told;
  told.id = the_sensor;
  told.type = sensor_fusion;
  auto& mounted = std::get<tr::vehicle_sensor>(told.detection_area.value);
  const auto behind_front_m = (car.front_m + car.rear_m) / 2;
  mounted.x = static_cast<std::int16_t>(std::lround(-100 * behind_front_m));
  mounted.properties.resize(1);
  auto& view = mounted.properties[0];
  view.range = static_cast<std::uint16_t>(
      std::clamp(std::lround(10 * can.range_m), 0L, 10'000L));
  const auto half =
      static_cast<std::uint16_t>(std::lround(5 * can.field_of_view_deg));
  view.horizontal_start =
      static_cast<std::uint16_t>((whole_circle - half) % whole_circle);
  view.horizontal_end = half;
  return told;
}

/// Only what looks ahead as far to the left as to the right is understood.
void look_through(const tr::sensor_information& told, world::viewpoint& eye) {
  const auto* mounted =
      std::get_if<tr::vehicle_sensor>(&told.detection_area.value);
  if (!mounted || mounted->properties.size() != 1)
    return;
  const auto& view = mounted->properties[0];
  const int from = view.horizontal_start, to = view.horizontal_end;
  if ((from + to) % whole_circle != 0)
    return;
  eye.range_m = 0.1 * view.range;
  eye.field_of_view_deg = 0.2 * to;
}

std::optional<timed_object> decode(const tr::perceived_object& told,
                                   const sender_frame& from,
                                   time_point generated) {
  if (!told.planar_dimension_1 || !told.planar_dimension_2 || !told.yaw)
    return std::nullopt;
  const auto vx = etsi::velocity_mps.to_si(told.x_speed.value);
  const auto vy = etsi::velocity_mps.to_si(told.y_speed.value);
  const auto yaw = etsi::angle_to_rad(told.yaw->value);
  if (!vx || !vy || !yaw)
    return std::nullopt;
  world::perceived_object what;
  what.length_m = 0.1 * told.planar_dimension_1->value;
  what.width_m = 0.1 * told.planar_dimension_2->value;
  if (!has_size(what))
    return std::nullopt;
  const point place{0.01 * told.x_distance.value.value,
                    0.01 * told.y_distance.value.value};
  const auto axis = unit_vector(*yaw);
  what.centre = from.at + out_of(from.axis, place);
  what.heading_rad = wrap_angle(from.heading_rad + *yaw);
  what.speed_mps = dot(axis, point{*vx, *vy});
  if (told.x_acceleration && told.y_acceleration) {
    const auto ax = etsi::accel_mps2.to_si(told.x_acceleration->value);
    const auto ay = etsi::accel_mps2.to_si(told.y_acceleration->value);
    if (ax && ay)
      what.accel_mps2 = dot(axis, point{*ax, *ay});
  }
  return timed_object{generated - milliseconds{told.time_of_measurement.value},
                      what, told.id};
}

} // namespace

tr::cpm make_cpm_tr103562(const perceived_scene& scene,
                          const world::vehicle_params& car,
                          const georeference& where) {
  const auto& own = scene.own;
  const auto place = where.frame.to_wgs84(front_of(own, car));
  const auto heading =
      where.frame.to_etsi_heading(own.heading_rad, own.position);
  tr::cpm message;
  message.header.station = own.station.value();
  const auto generated = where.clock.timestamp(own.at);
  message.body.generation = etsi::to_delta_time(generated);
  auto& body = message.body.parameters;
  body.management.station_type = etsi::passenger_car;
  body.management.position = to_reference(place);
  auto& sender =
      std::get<tr::originating_vehicle>(body.station_data.emplace().value);
  sender.heading.value = static_cast<std::uint16_t>(heading);
  sender.speed.value = wire<std::uint16_t>(etsi::speed_mps, own.speed_mps);
  if (scene.sensor)
    body.sensors.emplace().push_back(describe(*scene.sensor, car));
  body.number_of_objects =
      static_cast<std::uint8_t>(std::min<std::size_t>(scene.perceived, 255));
  const auto at = where.frame.to_map(place);
  const auto heading_rad = where.frame.to_map_heading(heading, own.position);
  if (scene.objects.empty() || !at || !heading_rad)
    return message;
  const sender_frame from{*at, *heading_rad};
  const auto age_ms = static_cast<int>(std::clamp<std::int64_t>(
      generated - where.clock.timestamp(scene.seen), -1500, 1500));
  auto& objects = body.objects.emplace();
  objects.resize(scene.objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i)
    describe(objects[i], scene.objects[i], from, age_ms);
  return message;
}

std::optional<object_list> read_cpm(const tr::cpm& message,
                                    const georeference& where, time_point now) {
  const auto& body = message.body.parameters;
  const auto at = where.frame.to_map(to_geo(body.management.position));
  const auto* sender =
      body.station_data
          ? std::get_if<tr::originating_vehicle>(&body.station_data->value)
          : nullptr;
  if (!at || !sender)
    return std::nullopt;
  const auto heading = where.frame.to_map_heading(sender->heading.value, *at);
  if (!heading)
    return std::nullopt;
  const auto generated = where.unwrapped(message.body.generation, now);
  const sender_frame from{*at, *heading};
  std::vector<timed_object> objects;
  if (body.objects)
    for (const auto& told : *body.objects)
      if (const auto x = decode(told, from, generated))
        objects.push_back(*x);
  auto seen =
      brought_together(message.header.station.value, generated, objects);
  seen.perceived = body.number_of_objects;
  auto& eye = seen.eye.emplace(*at, *heading);
  if (body.sensors && body.sensors->size() == 1)
    look_through(body.sensors->front(), eye);
  return seen;
}

} // namespace sofof::messages
