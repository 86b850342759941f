// One service requester among probes: its vehicle, two providers, and the
// managers of accepted services.
#pragma once

#include "actors/offloading/service_requester.hpp"
#include "tests/actors/spy_policies.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/toy_streets.hpp"
#include "tests/support/virtual_world.hpp"
#include "world/roads/streets.hpp"

#include <doctest/doctest.h>

#include <optional>
#include <string>
#include <utility>

namespace sofof::test {

struct requester_world : virtual_world {
  static constexpr station_id::rep station = 101;
  static constexpr provider_id::rep here = 11, elsewhere = 22;
  const messages::service_name one{"one"}, two{"two"};

  std::shared_ptr<lodm_script> lodm = std::make_shared<lodm_script>();
  probe<messages::vehicle_actor> vehicle = listen<messages::vehicle_actor>();
  probe<messages::recorder_actor> recorder = listen<messages::recorder_actor>();
  probe<messages::provider_actor> provider = listen<messages::provider_actor>();
  probe<messages::provider_actor> other = listen<messages::provider_actor>();
  probe<messages::provider_manager_actor> manager =
      listen<messages::provider_manager_actor>();
  world::streets_ptr world = one_street();
  messages::onboard_requester_actor requester = spawn();

  requester_world() {
    settle();
    drive_to(100);
    run_for(10s); // the clock's zero is no special time
    for (const auto& m : vehicle->all<messages::requester_manager_actor>())
      tell(m,
           messages::service_input{{}, now(), messages::payload::of(echo{1})});
    run_for(1s);
    vehicle->clear();
    recorder->clear();
  }

  static world::streets_ptr one_street() {
    auto world = std::make_shared<world::streets>();
    world->map = world::road_map{
        "street", {}, {toy::straight("street", {0, 0}, {2000, 0})}};
    world->routes.push_back(world->map.make_route(
        "street", std::vector<std::string>{"street"}, false));
    return world;
  }

  actors::requester_actor_setup setup() const {
    actors::requester_actor_setup setup;
    setup.station = station;
    setup.path_ahead = toy::path_ahead_on(world->routes.front());
    setup.services = {{echo_service("one")}, {echo_service("two")}};
    setup.lodm = std::make_unique<spy_lodm>(lodm);
    setup.vehicle = vehicle.handle;
    setup.recorder = recorder.handle;
    setup.noise = random_stream{1, "vehicle"};
    return setup;
  }

  messages::onboard_requester_actor spawn() {
    return own(actors::spawn_service_requester(system(), setup()));
  }

  // -- what happens to the requester --------------------------------------

  void drive_to(double x_m, double speed_mps = 15) {
    tell(requester,
         messages::ego_state{{station, now(), {x_m, 0}, 0, speed_mps, 0}, x_m});
  }
  void offer(std::vector<messages::service_name> kinds) {
    offer_from(provider, here, std::move(kinds));
  }
  void offer_from(const probe<messages::provider_actor>& from, provider_id id,
                  std::vector<messages::service_name> kinds) {
    tell_as(from.handle, requester,
            messages::service_offer{id, {500, 20}, std::move(kinds)});
  }

  /// Answers a request: counter 0 refuses.
  void
  answer(const messages::service_request& request,
         const std::vector<std::pair<messages::service_name, std::uint32_t>>&
             what) {
    messages::service_response response{
        request.provider, station, request.number, {}};
    std::vector<messages::provider_manager_actor> managers;
    for (const auto& [kind, counter] : what) {
      response.verdicts.push_back(
          {{request.provider, station, kind, counter}, counter > 0, "as told"});
      if (counter > 0)
        managers.push_back(manager.handle);
    }
    tell(requester, response, managers);
  }
  void result(const messages::session_id& r, std::uint64_t cycle,
              duration latency = 10ms) {
    tell(requester,
         messages::service_result{r, cycle, now() - latency,
                                  messages::payload::of(echo{cycle})});
  }

  messages::session_id at_here(const messages::service_name& kind,
                               std::uint32_t counter) const {
    return {here, station, kind, counter};
  }

  /// Brings the given services of the first provider to `starting`; counters
  /// rise from 7 on.
  void start(const std::vector<messages::service_name>& kinds) {
    offer(kinds);
    std::vector<std::pair<messages::service_name, std::uint32_t>> yes;
    for (std::uint32_t counter = 7; const auto& kind : kinds)
      yes.emplace_back(kind, counter++);
    answer(last_request(), yes);
  }
  /// The same, up to the first data.
  void start_remote(const std::vector<messages::service_name>& kinds) {
    start(kinds);
    for (std::uint32_t counter = 7; const auto& kind : kinds)
      result(at_here(kind, counter++), 1);
  }

  // -- what it has done ---------------------------------------------------

  messages::service_request last_request() const {
    const auto all = provider->all<messages::service_request>();
    REQUIRE(!all.empty());
    return all.back();
  }
  std::size_t requests() const {
    return provider->count<messages::service_request>();
  }
  std::vector<messages::service_end> ends() const {
    return provider->all<messages::service_end>();
  }
  std::vector<messages::episode_record> episodes() const {
    return recorder->all<messages::episode_record>();
  }
  std::vector<messages::decision_record> decisions() const {
    return recorder->all<messages::decision_record>();
  }

  /// @returns whether a service is remote now, as the client has it.
  bool is_remote(const messages::service_name& kind) const {
    bool remote = false;
    for (const auto& change : vehicle->all<messages::source_change>())
      if (change.service == kind)
        remote = change.remote;
    return remote;
  }
  std::vector<messages::service_result> local_results() const {
    std::vector<messages::service_result> found;
    for (const auto& r : vehicle->all<messages::service_result>())
      if (!r.session.is_remote())
        found.push_back(r);
    return found;
  }
};

} // namespace sofof::test
