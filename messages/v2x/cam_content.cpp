// What a CAM says of a vehicle.
#include "messages/v2x/cam_content.hpp"

#include "messages/etsi/units.hpp"
#include "messages/v2x/object_list.hpp"

#include <algorithm>

namespace sofof::messages {

point front_of(const cam& own, const world::vehicle_params& car) {
  return own.position + car.front_m * unit_vector(own.heading_rad);
}

etsi::cam make_cam(const cam& own, const world::vehicle_params& car,
                   const georeference& where) {
  etsi::cam message;
  message.header.station = own.station.value();
  message.body.generation = etsi::to_delta_time(where.clock.timestamp(own.at));
  auto& basic = message.body.parameters.basic;
  basic.station_type = etsi::passenger_car;
  basic.position = to_reference(where.frame.to_wgs84(front_of(own, car)));
  auto& motion = std::get<etsi::vehicle_high_frequency>(
      message.body.parameters.high_frequency.value);
  motion.heading.value = static_cast<std::uint16_t>(
      where.frame.to_etsi_heading(own.heading_rad, own.position));
  motion.speed.value = wire<std::uint16_t>(etsi::speed_mps, own.speed_mps);
  motion.drive_direction = etsi::drive_direction::forward;
  motion.length.value =
      wire<std::uint16_t>(etsi::vehicle_length_m, car.front_m + car.rear_m);
  motion.length.confidence = etsi::trailer_indication::none;
  motion.width = wire<std::uint8_t>(etsi::vehicle_width_m, car.width_m);
  motion.acceleration.value =
      wire<std::int16_t>(etsi::accel_mps2, own.accel_mps2);
  motion.curvature.value =
      wire<std::int16_t>(etsi::curvature_1pm, own.curvature_1pm);
  motion.curvature_mode = etsi::curvature_calculation_mode::yaw_rate_not_used;
  motion.yaw_rate.value = wire<std::int16_t>(etsi::yaw_rate_radps,
                                             own.curvature_1pm * own.speed_mps);
  return message;
}

void add_path(etsi::cam& message, const cam& own, const path_history& been,
              const georeference& where) {
  auto& low =
      std::get<0>(message.body.parameters.low_frequency.emplace().value);
  auto newer = message.body.parameters.basic.position;
  auto newer_at = own.at;
  for (std::size_t i = 0; i < been.size(); ++i) {
    const auto [at, when] = been[i];
    const auto place = where.frame.to_wgs84(at);
    etsi::path_point told;
    told.position.latitude = place.latitude - newer.latitude;
    told.position.longitude = place.longitude - newer.longitude;
    const auto before = (newer_at - when) / std::chrono::milliseconds{10};
    told.before.emplace(
        static_cast<std::int32_t>(std::clamp<std::int64_t>(before, 1, 65535)));
    low.path_history.push_back(told);
    newer = to_reference(place);
    newer_at = when;
  }
}

std::optional<cam> read_cam(const etsi::cam& message,
                            const world::vehicle_params& car,
                            const georeference& where, time_point now) {
  const auto& body = message.body;
  const auto* motion = std::get_if<etsi::vehicle_high_frequency>(
      &body.parameters.high_frequency.value);
  if (!motion)
    return std::nullopt;
  const auto front = where.frame.to_map(to_geo(body.parameters.basic.position));
  if (!front)
    return std::nullopt;
  const auto heading =
      where.frame.to_map_heading(motion->heading.value, *front);
  const auto speed = etsi::speed_mps.to_si(motion->speed.value);
  if (!heading || !speed)
    return std::nullopt;
  const auto our_length_m = car.front_m + car.rear_m;
  const auto length_m =
      etsi::vehicle_length_m.to_si(motion->length.value).value_or(our_length_m);
  cam own;
  own.station = message.header.station.value;
  own.at = where.unwrapped(body.generation, now);
  own.position =
      *front - car.front_m * length_m / our_length_m * unit_vector(*heading);
  own.length_m = length_m;
  own.width_m =
      etsi::vehicle_width_m.to_si(motion->width).value_or(car.width_m);
  own.heading_rad = *heading;
  own.speed_mps = *speed;
  own.accel_mps2 =
      etsi::accel_mps2.to_si(motion->acceleration.value).value_or(0);
  own.curvature_1pm =
      etsi::curvature_1pm.to_si(motion->curvature.value).value_or(0);
  return own;
}

} // namespace sofof::messages
