// What is seen, and what is known of it, as CPMs.
#include "actors/services/chain/track_words.hpp"

#include "base/protocol.hpp"
#include "messages/broadcast/decode_broadcast.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/perception.hpp"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

namespace sofof::actors {

namespace {

/// Of PerceivedObjectContainer, TS 103 324, there are 255; so many fit into the
/// longest message.
constexpr std::size_t most_told = 128;

messages::its_pdu cpm_of(const messages::perceived_scene& scene,
                         const planning_world& world) {
  return messages::encoded(
      messages::make_cpm_ts103324(scene, world.car, *world.where));
}

} // namespace

messages::its_pdu make_look_words(const messages::cam& own,
                                  const world::perception& seen,
                                  const planning_world& world) {
  std::vector<messages::known_object> objects;
  for (const auto& x : seen.objects)
    if (objects.size() < most_told)
      objects.push_back({static_cast<std::uint32_t>(objects.size()), x});
  messages::perceived_scene scene;
  scene.own = own;
  scene.seen = seen.at;
  scene.objects = objects;
  scene.perceived = seen.objects.size();
  return cpm_of(scene, world);
}

messages::its_pdu make_track_words(const track_teller& from, point near,
                                   std::span<const planners::track> tracks,
                                   station_id leaves_out,
                                   const planning_world& world) {
  std::vector<const planners::track*> chosen;
  for (const auto& x : tracks)
    if (x.station != leaves_out)
      chosen.push_back(&x);
  if (chosen.size() > most_told) {
    const auto is_nearer = [near](const auto* a, const auto* b) {
      return std::pair{distance_m(a->centre(), near), a->id}
             < std::pair{distance_m(b->centre(), near), b->id};
    };
    std::ranges::nth_element(chosen, chosen.begin() + most_told, is_nearer);
    chosen.resize(most_told);
    std::ranges::sort(chosen, {}, &planners::track::id);
  }
  std::vector<messages::known_object> objects;
  for (const auto* x : chosen)
    objects.push_back({x->id,
                       {x->centre(), x->heading_rad, x->speed_mps(),
                        x->accel_mps2, x->length_m, x->width_m}});
  messages::perceived_scene scene;
  scene.own = from.own;
  scene.seen = chosen.empty() ? from.own.at : chosen.front()->at;
  scene.objects = objects;
  scene.perceived = tracks.size();
  scene.at_roadside = from.at_roadside;
  return cpm_of(scene, world);
}

std::optional<messages::object_list>
read_objects(const messages::its_pdu& message, const planning_world& world,
             time_point now) {
  auto word = messages::decode(message, *world.where, now);
  auto* objects = std::get_if<messages::object_list>(&word);
  if (!objects || protocol::is_of_future(objects->at, now)
      || protocol::is_of_future(objects->generated, now))
    return std::nullopt;
  return std::move(*objects);
}

} // namespace sofof::actors
