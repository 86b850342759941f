// Planners of trajectories without actors, on board and at a provider, at a
// time that a test sets.
#pragma once

#include "actors/offloading/broadcast_listener.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/service_type.hpp"
#include "messages/broadcast/decode_broadcast.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>
#include <variant>

namespace sofof::test {

using namespace std::chrono_literals;

/// A round and two open ways over crossings; each begins like another one.
inline world::streets_ptr blocks() {
  auto world = std::make_shared<world::streets>();
  world->map = toy::grid(3, 100);
  world->routes = {toy::make_route(world->map, {0, 1, 4, 3}, true),
                   toy::make_route(world->map, {3, 4, 5}),
                   toy::make_route(world->map, {0, 1, 2})};
  return world;
}

/// One planner of a vehicle.
class planning {
public:
  static constexpr time_point start{100s};
  static constexpr station_id::rep station = 101;
  static constexpr station_id::rep provider = 9001;

  explicit planning(bool at_provider, bool crossings_granted = true)
      : world{.streets = blocks(),
              .where = in_ulm(),
              .crossings_granted = crossings_granted} {
    const auto clock = [t = now] { return *t; };
    const auto service =
        actors::make_service_type("trajectory_planning")->in(world);
    vehicle = service.in_vehicle({station, clock});
    if (at_provider)
      there = service.at_provider({provider, {150, 50}, clock});
    function = there ? there->make_function(station) : vehicle->make_function();
  }

  world::route_ptr way(const std::string& name) const {
    return world.streets->find(name);
  }

  offloading::service_output run(const messages::payload& what,
                                 const messages::payload& in_use = {}) {
    return function->run(*now, {running, *now, what, in_use});
  }

  /// Gives the planner of a vehicle what it asks.
  std::shared_ptr<const world::trajectory>
  ask(const actors::plan_request& request,
      const messages::payload& in_use = {}) {
    return run(messages::payload::of(request), in_use)
        .what.as<world::trajectory>();
  }

  // -- at a provider --------------------------------------------------------

  /// A message that everybody hears comes in.
  void hear(const messages::its_pdu& message) {
    const auto heard = messages::decode(message, *world.where, *now);
    if (const auto* own = std::get_if<messages::cam>(&heard))
      actors::listener_of(*there)->on_cam(*own, own->station.value());
    if (const auto* seen = std::get_if<messages::object_list>(&heard))
      actors::listener_of(*there)->on_objects(*seen, seen->from.value());
  }

  /// A vehicle comes in that has been heard for a second, and knows all that is
  /// round it.
  void meet(const messages::cam& own) {
    auto before = own;
    *now -= 1s;
    before.at -= 1s;
    hear(pdu_of(before));
    *now += 1s;
    hear(pdu_of(own));
  }

  /// @returns the vehicle's word to who plans for it, or takes over.
  messages::payload word(const actors::plan_request& request,
                         const messages::payload& in_use = {},
                         bool takes_over = false) const {
    return vehicle
        ->encode_input(
            {running, request.from.at, messages::payload::of(request), in_use},
            takes_over)
        .what;
  }

  /// @returns what the vehicle makes of a result, when that comes.
  std::shared_ptr<const world::trajectory>
  understood(const offloading::service_output& result,
             const actors::plan_request& of,
             const world::trajectory* before = nullptr) const {
    if (auto own = result.what.as<world::trajectory>())
      return own;
    auto plan = vehicle->make_judge()
                    ->judge(result.what,
                            {running, of.from.at, messages::payload::of(of),
                             before ? messages::payload::of(*before)
                                    : messages::payload{}},
                            *now)
                    .what.as<world::trajectory>();
    REQUIRE((!plan || plan->is_sound()));
    return plan;
  }

  /// @returns the request of a vehicle that is there now.
  actors::plan_request at(const std::string& name, double s_m,
                          double speed_mps) const {
    const auto p = way(name)->path().at(s_m);
    actors::plan_request x;
    x.way = name;
    x.from.at = x.seen.at = *now;
    x.from.s_m = s_m;
    x.from.curvature_1pm = p.curvature_1pm;
    x.from.speed_mps = speed_mps;
    x.own = {station, *now, p.at, p.heading_rad, speed_mps, 0, p.curvature_1pm};
    return x;
  }

  std::shared_ptr<time_point> now = std::make_shared<time_point>(start);
  messages::session_id running{11, station, "trajectory_planning", 7};
  actors::service_world world;
  std::shared_ptr<offloading::vehicle_service> vehicle;
  std::shared_ptr<offloading::provider_service> there; ///< Perhaps null.
  std::shared_ptr<offloading::service_function> function;
};

} // namespace sofof::test
