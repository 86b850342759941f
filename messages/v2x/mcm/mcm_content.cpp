// What vehicles and whoever plans for them say to each other.
#include "messages/v2x/mcm/mcm_content.hpp"

#include "messages/etsi/units.hpp"
#include "messages/v2x/cam_content.hpp"

#include <cmath>

namespace sofof::messages {

namespace {

/// Waypoints farther away than this from the reference do not fit, m.
constexpr double farthest_waypoint_m = 1300;

etsi::reference_position_with_confidence reference(const geo_position& at) {
  etsi::reference_position_with_confidence position;
  position.latitude = at.latitude;
  position.longitude = at.longitude;
  return position;
}

/// The beginning of every message.
/// @returns what its waypoints refer to.
maneuver_frame begin(etsi::mcm& message, station_id from, std::uint8_t type,
                     point at, time_point t, const georeference& where) {
  message.header.station = from.value();
  message.body.generation = etsi::to_delta_time(where.clock.timestamp(t));
  const auto place = place_maneuver(where.frame, at, t);
  message.body.parameters.basic.station_type = type;
  message.body.parameters.basic.position = reference(place.reference);
  return place.frame;
}

std::optional<maneuver_frame>
frame_of(const etsi::mcm& message, const georeference& where, time_point now) {
  const auto& position = message.body.parameters.basic.position;
  const auto at = where.frame.to_map({position.latitude, position.longitude});
  if (!at)
    return std::nullopt;
  return maneuver_frame{where.frame, *at,
                        where.unwrapped(message.body.generation, now)};
}

etsi::waypoint waypoint_at(point at, const maneuver_frame& frame) {
  const auto away =
      frame.earth.to_east_north(at - frame.reference, frame.reference);
  return {etsi::mcm_distance_m.to_wire(away.x_m),
          etsi::mcm_distance_m.to_wire(away.y_m)};
}

point place_of(const etsi::waypoint& x, const maneuver_frame& frame) {
  return frame.reference
         + frame.earth.to_map_axes({0.01 * x.x.value, 0.01 * x.y.value},
                                   frame.reference);
}

template <class Number>
Number narrowed(std::int32_t x) {
  return static_cast<Number>(x);
}

etsi::planned_trajectory written(const planned_points& plan) {
  etsi::planned_trajectory out;
  out.start_delta_time = narrowed<std::uint16_t>(plan.start_ms);
  out.delta_time = narrowed<std::uint8_t>(plan.step_ms);
  for (const auto& p : plan.points) {
    etsi::trajectory_point& to = out.points.emplace_back();
    to.waypoint = {p.x_cm, p.y_cm};
    to.speed = narrowed<std::uint16_t>(p.speed_cmps);
    to.heading = narrowed<std::uint16_t>(p.heading);
  }
  return out;
}

/// The largest number stands for all that is larger, too.
std::optional<double> told_size_m(const etsi::road_user_size& x) {
  if (x.value == etsi::road_user_size_unavailable)
    return std::nullopt;
  return etsi::road_user_size_m.to_si(x.value);
}

planned_points understood(const etsi::planned_trajectory& plan) {
  planned_points out{plan.start_delta_time, plan.delta_time, {}};
  for (const auto& p : plan.points)
    out.points.push_back(
        {p.waypoint.x, p.waypoint.y, p.speed.value, p.heading.value});
  return out;
}

} // namespace

// -- up -----------------------------------------------------------------------

etsi::mcm make_word(const mcm_uplink& word, const world::vehicle_params& car,
                    const georeference& where) {
  const auto& own = word.own;
  etsi::mcm message;
  const auto frame = begin(message, own.station, etsi::passenger_car,
                           front_of(own, car), own.at, where);
  auto& user = std::get<etsi::road_user_container>(
      message.body.parameters.maneuver.value);
  user.state.type = etsi::road_user_type::connected_automated_vehicle;
  user.state.speed =
      narrowed<std::uint16_t>(etsi::speed_mps.to_wire(own.speed_mps));
  user.state.heading = narrowed<std::uint16_t>(
      where.frame.to_etsi_heading(own.heading_rad, own.position));
  user.state.length = narrowed<std::uint8_t>(
      etsi::road_user_size_m.to_wire(car.front_m + car.rear_m));
  user.state.width =
      narrowed<std::uint8_t>(etsi::road_user_size_m.to_wire(car.width_m));
  if (!word.way.empty()) {
    auto& way = user.desired_route.emplace();
    for (const auto& at : word.way)
      way.push_back(waypoint_at(at, frame));
  }
  planned_points plan;
  if (word.plan
      && to_planned_points(world::rest_of(*word.plan, own.at), frame, plan))
    user.planned_trajectory = written(plan);
  if (word.answer) {
    const auto& [name, followed] = *word.answer;
    user.advice_response = {name.maneuver, name.update, followed};
  }
  return message;
}

std::optional<decoded_mcm>
read_word(const etsi::mcm& message, const georeference& where, time_point now) {
  const auto* user = std::get_if<etsi::road_user_container>(
      &message.body.parameters.maneuver.value);
  const auto frame = frame_of(message, where, now);
  if (!user || !frame)
    return std::nullopt;
  decoded_mcm word;
  word.from = message.header.station.value;
  word.at = frame->generated;
  word.reference = frame->reference;
  word.length_m = told_size_m(user->state.length);
  word.width_m = told_size_m(user->state.width);
  if (user->desired_route)
    for (const auto& x : *user->desired_route)
      word.way.push_back(place_of(x, *frame));
  if (user->planned_trajectory)
    word.plan = understood(*user->planned_trajectory);
  if (const auto& answer = user->advice_response)
    word.answer.emplace(
        maneuver_name{answer->maneuver_id, answer->advice_update_id},
        answer->followed);
  return word;
}

// -- down ---------------------------------------------------------------------

namespace {

/// @returns what of `x` holds a T, its room kept if it did already.
template <class T>
T& made(auto& x) {
  auto* is = std::get_if<T>(&x);
  return is ? *is : x.template emplace<T>();
}

etsi::suggested_maneuver& suggest(etsi::mcm& message, const suggestion& what) {
  auto& to = made<etsi::suggested_maneuver_container>(
      message.body.parameters.maneuver.value);
  to.target = what.to.value();
  auto& maneuver = to.maneuver ? *to.maneuver : to.maneuver.emplace();
  maneuver.maneuver_id = what.name.maneuver;
  maneuver.advice_update_id = what.name.update;
  maneuver.participants.clear();
  maneuver.participants.push_back(what.to.value());
  return maneuver;
}

} // namespace

bool make_suggestion(const suggestion& what, const world::trajectory& plan,
                     const georeference& where,
                     std::vector<maneuver_waypoint>& room, etsi::mcm& out) {
  const auto near =
      distance_m(plan.points.front().at, what.position) < farthest_waypoint_m
      && distance_m(plan.points.back().at, what.position) < farthest_waypoint_m;
  const auto frame =
      begin(out, what.from, etsi::roadside_unit,
            near ? what.position : plan.points.front().at, plan.start, where);
  if (!to_waypoints(plan, frame, room))
    return false;
  auto& waypoints =
      made<etsi::maneuver_constraints>(suggest(out, what).parameters.value)
          .waypoints;
  waypoints.resize(room.size());
  auto next = waypoints.begin();
  for (const auto& x : room) {
    auto& to = *next++;
    to.waypoint = {x.x_cm, x.y_cm};
    to.min_arrival_time = to.max_arrival_time = narrowed<std::uint16_t>(x.t_ms);
    to.min_velocity = to.max_velocity =
        etsi::speed_value{narrowed<std::uint16_t>(x.speed_cmps)};
  }
  return true;
}

etsi::mcm make_termination(const suggestion& what, time_point at,
                           etsi::termination_status why,
                           const georeference& where) {
  etsi::mcm message;
  begin(message, what.from, etsi::roadside_unit, what.position, at, where);
  suggest(message, what).parameters.value = why;
  return message;
}

etsi::mcm make_silence(const suggestion& what, time_point at,
                       const georeference& where) {
  etsi::mcm message;
  begin(message, what.from, etsi::roadside_unit, what.position, at, where);
  made<etsi::suggested_maneuver_container>(
      message.body.parameters.maneuver.value)
      .target = what.to.value();
  return message;
}

namespace {

const etsi::suggested_maneuver_container*
suggestion_in(const etsi::mcm& message) {
  return std::get_if<etsi::suggested_maneuver_container>(
      &message.body.parameters.maneuver.value);
}

const etsi::maneuver_constraints*
plan_in(const etsi::suggested_maneuver_container* to) {
  return to && to->maneuver ? std::get_if<etsi::maneuver_constraints>(
             &to->maneuver->parameters.value)
                            : nullptr;
}

const etsi::maneuver_constraints* suggested_to(station_id me,
                                               const etsi::mcm& message) {
  const auto* to = suggestion_in(message);
  return to && me == to->target.value ? plan_in(to) : nullptr;
}

} // namespace

std::optional<maneuver_fault>
read_suggestion(const etsi::mcm& message, station_id me,
                const world::route& way, double s_guess_m,
                const georeference& where, time_point now,
                const world::trajectory* before, world::trajectory& out) {
  const auto* plan = suggested_to(me, message);
  const auto frame = frame_of(message, where, now);
  if (!plan || !frame)
    return std::nullopt;
  if (plan->corridor)
    return maneuver_fault::not_understood;
  std::vector<maneuver_waypoint> waypoints;
  waypoints.reserve(plan->waypoints.size());
  for (const auto& x : plan->waypoints) {
    if (!x.min_velocity || x.min_arrival_time != x.max_arrival_time
        || (x.max_velocity && *x.max_velocity != *x.min_velocity)
        || x.min_duration_of_stop || x.preceding || x.following || x.yield_to)
      return maneuver_fault::not_understood;
    waypoints.push_back({x.waypoint.x, x.waypoint.y, x.min_arrival_time.value,
                         x.min_velocity->value});
  }
  return to_trajectory(waypoints, *frame, way, s_guess_m, before, out);
}

std::uint64_t fingerprint_of_plan(const etsi::mcm& message) {
  const auto* plan = plan_in(suggestion_in(message));
  if (!plan)
    return 0;
  std::uint64_t h = 1;
  const auto add = [&h](std::int32_t x) {
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15; // 2^64 / golden ratio
    h = (h ^ static_cast<std::uint32_t>(x)) * odd;
    h ^= h >> 32;
  };
  for (const auto& x : plan->waypoints) {
    add(x.waypoint.x.value);
    add(x.waypoint.y.value);
    add(x.min_velocity ? x.min_velocity->value : -1);
  }
  return h;
}

} // namespace sofof::messages
