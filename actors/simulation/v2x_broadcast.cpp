// What a vehicle tells everybody.
#include "actors/simulation/v2x_broadcast.hpp"

#include "messages/v2x/cam_content.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/perception.hpp"

namespace sofof::actors {

namespace {

/// A CPM cannot tell of anything that was seen longer ago.
/// Source: TimeOfMeasurement, TR 103 562 V2.1.1.
constexpr duration oldest_sight = std::chrono::milliseconds{1500};

messages::told_motion motion_of(const messages::cam& own) {
  return {own.position, own.heading_rad, own.speed_mps};
}

world::perceived_object object_of(const planners::track& x) {
  return {x.centre(),   x.heading_rad, x.speed_mps(),
          x.accel_mps2, x.length_m,    x.width_m};
}

} // namespace

v2x_broadcast::v2x_broadcast(const messages::v2x_options& options,
                             const world::vehicle_params& car,
                             const world::sensor_params& sensor,
                             messages::georeference_ptr where)
    : options_{options}, car_{car}, sensor_{sensor}, where_{std::move(where)},
      cam_due_{options.cam_rule()} {
  if (options.sends_cpms())
    seen_ = std::make_unique<seen_bodies>(
        seen_bodies{messages::cpm_trigger{options.cpm_rule()},
                    planners::object_tracker{planners::noise_of(sensor)},
                    {},
                    {}});
}

std::optional<messages::its_pdu>
v2x_broadcast::awareness(const messages::cam& own) {
  been_.pass(own.at, messages::front_of(own, car_));
  const auto due = cam_due_.check(own.at, motion_of(own));
  if (!due.send)
    return std::nullopt;
  auto message = messages::make_cam(own, car_, *where_);
  if (due.low_frequency)
    messages::add_path(message, own, been_, *where_);
  return messages::encoded(message);
}

std::optional<messages::its_pdu>
v2x_broadcast::perceived(const messages::cam& own,
                         const world::perception& seen) {
  if (!seen_)
    return std::nullopt;
  auto& [cpm_due, model, known, told] = *seen_;
  model.update(seen.at, seen.objects);
  known.clear();
  for (const auto& x : model.tracks())
    if (x.seen == seen.at // not those that are only remembered
        && own.at - seen.at <= oldest_sight)
      known.push_back({x.id, object_of(x)});
  const auto due = cpm_due.check(own.at, known);
  if (!due.send)
    return std::nullopt;
  told.clear();
  for (const auto i : due.objects)
    told.push_back(known[i]);
  const messages::perceived_scene scene{own, seen.at, told, known.size(),
                                        due.sensor_information ? &sensor_
                                                               : nullptr};
  return options_.is_release_2()
             ? messages::encoded(
                 messages::make_cpm_ts103324(scene, car_, *where_))
             : messages::encoded(
                 messages::make_cpm_tr103562(scene, car_, *where_));
}

} // namespace sofof::actors
