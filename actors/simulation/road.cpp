// The streets and all that moves on them, and what sensors see of it.
#include "actors/simulation/road.hpp"

#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "base/protocol.hpp"
#include "world/traffic/near_miss.hpp"
#include "world/traffic/spawn_clearance.hpp"
#include "world/traffic/traffic.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace sofof::actors {

namespace {

using road_impl =
    messages::road_actor::extend<messages::reacts_to<messages::tick_atom>>;

std::vector<world::road_body>
standing(const std::vector<oriented_box>& obstacles) {
  std::vector<world::road_body> bodies;
  for (std::uint32_t k = 0; k < obstacles.size(); ++k)
    bodies.push_back({obstacle_id(k), obstacles[k], 0, 0});
  return bodies;
}

struct road_state {
  static inline const char* name = "road";

  road_impl::stateful_pointer<road_state> self;
  road_setup setup;
  std::optional<world::traffic> users;
  world::scene visible;
  std::map<station_id, messages::vehicle_actor> vehicles;
  std::map<station_id,
           std::pair<messages::motion_report, messages::vehicle_actor>>
      waiting;
  std::vector<std::pair<station_id, station_id>> touching;
  world::near_miss_watch conflict_sides;
  time_point begin;

  void on_report(const messages::motion_report& report,
                 const messages::vehicle_actor& vehicle) {
    const auto way = setup.ways.find(report.station);
    if (way == setup.ways.end())
      return;
    vehicles.try_emplace(report.station, vehicle);
    world::road_user user;
    user.station = report.station;
    user.on = way->second;
    user.s_m = report.s_m;
    user.speed_mps = report.state.speed_mps;
    user.accel_mps2 = report.state.accel_mps2;
    user.front_m = setup.car.front_m;
    user.rear_m = setup.car.rear_m;
    user.body = world::body(report.state, setup.car);
    users->report(user);
  }

  void forget(station_id station) {
    if (vehicles.erase(station) > 0)
      users->remove(station);
  }

  // In the order of their stations; who was let in is in the others' way.
  void let_in() {
    if (waiting.empty())
      return;
    const auto all = users->bodies();
    std::vector<world::road_body> present{all.begin(), all.end()};
    std::erase_if(waiting, [&](const auto& entry) {
      const auto& [report, vehicle] = entry.second;
      const auto place = world::body(report.state, setup.car);
      const auto speed_mps = report.state.speed_mps;
      if (!world::is_free(place, speed_mps, present))
        return false;
      present.push_back({report.station, place, speed_mps, 0});
      on_report(report, vehicle);
      self->send(vehicle, messages::begin_atom_v);
      return true;
    });
  }

  void place_scripted(time_point t) {
    if (setup.scripted.empty())
      return;
    std::vector<world::road_body> there;
    for (const auto& one : setup.scripted)
      if (const auto body = one.at(to_seconds(t - begin)))
        there.push_back(*body);
    users->place(std::move(there));
  }

  void tick() {
    const auto t = now(self);
    send_at(self, self, t + protocol::sensor_period, messages::tick_atom_v);
    place_scripted(t);
    let_in();
    users->update(t);
    visible.place(users->bodies());
    show_vehicles(t);
    for (std::uint32_t k = 0; k < setup.beside.size(); ++k) {
      const auto& [provider, is] = setup.beside[k];
      self->send(provider, messages::roadside_detections{
                               t, visible.seen_by(is, t), k, is.view()});
    }
    record_collisions(t);
    record_near_misses(t);
  }

  void show_vehicles(time_point t) {
    for (const auto& user : users->bodies()) {
      const auto vehicle = vehicles.find(user.id);
      if (vehicle == vehicles.end())
        continue; // an obstacle
      auto view = users->perceive(user.id);
      view.objects =
          visible.seen_by({setup.sensors, setup.noise.part(user.id.value()),
                           user.box.centre, user.box.heading_rad, user.id},
                          t);
      self->send(vehicle->second, std::move(view));
    }
  }

  void record_collisions(time_point t) {
    auto touch = users->collisions();
    for (const auto& pair : touch)
      if (!std::ranges::binary_search(touching, pair))
        send_record(self, setup.recorder,
                    messages::collision_record{t, pair.first, pair.second});
    touching = std::move(touch);
  }

  // Of vehicles only: what stands on the road is passed closely.
  void record_near_misses(time_point t) {
    for (const auto& x : conflict_sides.look(users->users(), t))
      send_record(self, setup.recorder,
                  messages::event_record{
                      .at = t,
                      .what = messages::event_type::near_miss,
                      .station = x.first,
                      .detail = fmt::format(
                          "with {} ttc_s={:.3f} limit_s={:.3f}", x.second,
                          x.time_to_collision_s, world::near_miss_s)});
  }
};

road_impl::behavior_type road(road_impl::stateful_pointer<road_state> self,
                              road_setup setup) {
  auto& state = self->state;
  state.self = self;
  state.begin = now(self);
  state.users.emplace(setup.world->map, standing(setup.obstacles),
                      setup.grants_crossings);
  state.visible = world::scene{setup.world->map.buildings()};
  state.setup = std::move(setup);
  self->send(self, messages::tick_atom_v);
  return {
      [self](const messages::motion_report& report,
             const messages::vehicle_actor& vehicle) {
        self->state.on_report(report, vehicle);
      },
      [self](messages::begin_atom, const messages::motion_report& report,
             const messages::vehicle_actor& vehicle) {
        self->state.waiting.try_emplace(report.station, report, vehicle);
      },
      [self](station_id::rep station) { self->state.forget(station); },
      [self](messages::tick_atom) { self->state.tick(); },
  };
}

} // namespace

messages::road_actor spawn_road(caf::actor_system& sys, road_setup setup) {
  return sys.spawn(road, std::move(setup));
}

} // namespace sofof::actors
