// Scenes as scene messages, rounded to the cautious side: read.
#include "actors/services/planning/scene_words.hpp"

#include "actors/services/planning/scene_units.hpp"
#include "base/protocol.hpp"
#include "messages/v2x/encoded.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace sofof::actors {
namespace {

using messages::scene_message;
namespace heard = messages::scene;
using namespace scene_units;

planners::way_stretch understood(const heard::stretch& x) {
  return {length.si(x.from), length.si(x.from.value + x.length.value)};
}

void read_lead(const heard::lead& x, planners::driving_scene& out) {
  auto& lead = out.lead.emplace();
  if (x.station)
    lead.station = x.station->value;
  lead.rear_s_m = length.si(x.rear);
  lead.speed_mps = lead_speed.si(x.speed);
  lead.accel_mps2 = lead_accel.si(x.accel);
  if (!x.told)
    return;
  std::int32_t at = x.rear, time = 0;
  for (const auto& moment : *x.told) {
    at += moment.way;
    time += moment.time.value;
    out.lead_told.push_back({length.si(at), instant.si(time)});
  }
}

planners::crossing_user understood(const heard::crossing& x) {
  const auto on = understood(x.on);
  return {on.from_m,
          on.to_m,
          instant.si(x.enter),
          x.stay == heard::stays_for_ever ? never
                                          : instant.si(x.enter + x.stay),
          x.goes_first,
          x.brakes == heard::brakes_beyond ? never : braking.si(x.brakes),
          x.body};
}

planners::lane_obstacle understood(const heard::body_beside& x) {
  const auto along = understood(x.along);
  return {along.from_m,
          along.to_m,
          lateral.si(x.low),
          lateral.si(x.high),
          beside_speed.si(x.speed.value),
          lateral.si(x.lacks.value),
          lateral.si(x.left.value)};
}

} // namespace

std::optional<decoded_scene>
read_scene_words(const messages::its_pdu& message,
                 const messages::georeference& where, time_point now) {
  scene_message told;
  if (!messages::etsi::decode(message.view(), told) || !is_in_order(told.body))
    return std::nullopt;
  const auto& body = told.body;
  const auto position =
      where.frame.to_map({body.reference.latitude, body.reference.longitude});
  if (!position)
    return std::nullopt;
  decoded_scene out;
  out.from = told.header.station.value;
  out.at = where.ahead_by(message.ahead).unwrapped(body.generation, now);
  out.seen = out.at - std::chrono::milliseconds{body.age.value};
  out.position = *position;
  auto& scene = out.scene;
  scene.at = out.at;
  scene.is_impatient = body.is_impatient;
  if (body.lead)
    read_lead(*body.lead, scene);
  for (const auto& x : body.crossings)
    scene.crossings.push_back(understood(x));
  for (const auto& x : body.beside)
    scene.beside.push_back(understood(x));
  for (const auto& x : body.yields)
    scene.yields_m.push_back(length.si(x));
  for (const auto& x : body.keep_free)
    scene.keep_free.push_back(understood(x));
  return out;
}

// -- along the way ------------------------------------------------------------

bool holds(const decoded_scene& scene, time_point now) {
  constexpr duration oldest = std::chrono::seconds{1};
  return !protocol::is_of_future(scene.at, now) && now - scene.at <= oldest;
}

void move(planners::driving_scene& scene, double by_m) {
  assert(std::isfinite(by_m));
  const auto move_stretch = [by_m](auto& x) {
    x.from_m += by_m;
    x.to_m += by_m;
  };
  if (scene.lead)
    scene.lead->rear_s_m += by_m;
  for (auto& x : scene.lead_told)
    x.s_m += by_m;
  if (auto& agreed = scene.agreed) {
    for (auto& x : agreed->axle)
      x.s_m += by_m;
    agreed->binds_from_m += by_m;
    if (agreed->waits_at_m)
      *agreed->waits_at_m += by_m;
  }
  if (scene.stop_at_m)
    *scene.stop_at_m += by_m;
  std::ranges::for_each(scene.crossings, move_stretch);
  std::ranges::for_each(scene.beside, move_stretch);
  for (auto& s_m : scene.yields_m)
    s_m += by_m;
  std::ranges::for_each(scene.keep_free, move_stretch);
}

} // namespace sofof::actors
