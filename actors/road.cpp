// The streets and all that moves on them, as sensors would show it.
#include "actors/road.hpp"

#include "actors/time.hpp"
#include "world/protocol.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace sofof {

namespace {

using road_impl = road_actor::extend<takes<tick_atom>>;

struct road_state {
  static inline const char* name = "road";

  road_impl::stateful_pointer<road_state> self;
  streets_ptr world;
  station_routes ways;
  vehicle_params car;
  recorder_actor recorder;
  std::optional<traffic> users;
  std::map<station_id, vehicle_actor> vehicles;
  std::vector<std::pair<station_id, station_id>> touching;

  void take(const motion_report& report, const vehicle_actor& vehicle) {
    const auto way = ways.find(report.station);
    if (way == ways.end())
      return;
    vehicles.try_emplace(report.station, vehicle);
    road_user user;
    user.station = report.station;
    user.on = way->second;
    user.s_m = report.s_m;
    user.speed_mps = report.state.speed_mps;
    user.accel_mps2 = report.state.accel_mps2;
    user.front_m = car.front_m;
    user.rear_m = car.rear_m;
    user.body = body(report.state, car);
    users->report(user);
  }

  void forget(station_id station) {
    if (vehicles.erase(station) > 0)
      users->remove(station);
  }

  void tick() {
    const auto t = now(self);
    send_at(self, self, t + protocol::sensor_period, tick_atom_v);
    users->update(t);
    for (const auto& [station, vehicle] : vehicles)
      self->send(vehicle, users->perceive(station));
    auto touch = users->collisions();
    for (const auto& pair : touch)
      if (!std::ranges::binary_search(touching, pair))
        self->send(recorder, collision_record{t, pair.first, pair.second});
    touching = std::move(touch);
  }
};

road_impl::behavior_type road(road_impl::stateful_pointer<road_state> self,
                              streets_ptr world, station_routes ways,
                              vehicle_params car, recorder_actor recorder,
                              bool grants_crossings) {
  auto& state = self->state;
  state.self = self;
  state.world = std::move(world);
  state.ways = std::move(ways);
  state.car = car;
  state.recorder = std::move(recorder);
  state.users.emplace(state.world->map, grants_crossings);
  self->send(self, tick_atom_v);
  return {
      [self](const motion_report& report, const vehicle_actor& vehicle) {
        self->state.take(report, vehicle);
      },
      [self](station_id station) { self->state.forget(station); },
      [self](tick_atom) { self->state.tick(); },
  };
}

} // namespace

road_actor spawn_road(caf::actor_system& sys, streets_ptr world,
                      station_routes ways, vehicle_params car,
                      recorder_actor recorder, bool grants_crossings) {
  return sys.spawn(road, std::move(world), std::move(ways), car,
                   std::move(recorder), grants_crossings);
}

} // namespace sofof
