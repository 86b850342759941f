// A service that the framework has never heard of runs through it all the
// same: offered, requested, accepted, used, ended.
#include "tests/support/echo_service.hpp"

#include "actors/offloading/service_provider.hpp"
#include "actors/offloading/service_requester.hpp"
#include "actors/services/service_type.hpp"
#include "actors/simulation/network_link.hpp"
#include "policies/registry.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/toy_streets.hpp"
#include "tests/support/virtual_world.hpp"
#include "world/roads/streets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::channel;
using namespace sofof::messages;
using namespace sofof::policies;
using namespace sofof::test;
using namespace sofof::world;

namespace {

/// A requester and a provider, joined by an ideal link; the vehicle is a
/// probe.
struct echo_world : virtual_world {
  static constexpr station_id::rep station = 101;
  probe<vehicle_actor> vehicle = listen<vehicle_actor>();
  probe<recorder_actor> recorder = listen<recorder_actor>();
  streets_ptr world = one_street();
  offloading::service service = echo_service("never_heard_of");
  provider_actor provider = own(spawn_provider());
  link_actor link = own(spawn_link());
  onboard_requester_actor requester = own(spawn_requester());
  std::uint64_t said = 0;

  echo_world() { settle(); }

  static streets_ptr one_street() {
    auto world = std::make_shared<streets>();
    world->map =
        road_map{"street", {}, {toy::straight("street", {-500, 0}, {500, 0})}};
    world->routes.push_back(world->map.make_route(
        "street", std::vector<std::string>{"street"}, false));
    return world;
  }

  std::shared_ptr<const channel_profile> profile() {
    return std::make_shared<channel_profile>(*find_channel_profile("ideal"));
  }
  provider_actor spawn_provider() {
    provider_actor_setup s;
    s.id = 1;
    s.area = polygon::regular({0, 0}, 100, 24);
    s.map = {world, &world->map};
    s.decode = decode_in_ulm();
    s.services = {service};
    s.codm = make_codm("location");
    s.recorder = recorder.handle;
    return spawn_service_provider(system(), std::move(s));
  }
  link_actor spawn_link() {
    const channel_draws draws{profile(), random_stream{1, "network"}, station,
                              0};
    return spawn_network_link(system(), provider,
                              {{{draws, direction::up, nullptr}},
                               {{draws, direction::down, nullptr}},
                               {}});
  }
  onboard_requester_actor spawn_requester() {
    requester_actor_setup s;
    s.station = station;
    s.path_ahead = toy::path_ahead_on(world->routes.front());
    s.services = {{service}};
    s.lodm = make_lodm("always");
    s.vehicle = vehicle.handle;
    s.recorder = recorder.handle;
    return spawn_service_requester(system(), std::move(s));
  }

  /// Stands at a place and talks at 10 Hz.
  void stand_at(double x_m, duration d) {
    const auto manager = vehicle->all<requester_manager_actor>().front();
    for (const auto end = now() + d; now() < end; run_for(100ms)) {
      const cam own{station, now(), {x_m, 0}, 0, 0, 0};
      tell(requester, ego_state{own, x_m + 500});
      tell(link, pdu_of(own), requester_actor{requester});
      tell(manager, service_input{{}, now(), payload::of(echo{++said})});
    }
  }
  std::size_t results(bool remote) const {
    const auto all = vehicle->all<service_result>();
    return static_cast<std::size_t>(
        std::ranges::count_if(all, [&](const service_result& r) {
          return r.session.is_remote() == remote;
        }));
  }
};

} // namespace

TEST_CASE("the echo service is defined in the tests alone") {
  for (const auto name : service_type_names())
    CHECK(name != "never_heard_of");
}

TEST_CASE_FIXTURE(echo_world, "outside the area an unheard-of service runs "
                              "at home") {
  stand_at(200, 5s);
  CHECK(results(true) == 0);
  CHECK(results(false) > 90);
}

TEST_CASE_FIXTURE(echo_world, "inside the area an unheard-of service runs at "
                              "the provider, outside it comes home") {
  stand_at(200, 1s);
  stand_at(0, 5s);
  const auto remote = results(true);
  CHECK(remote > 90);
  CHECK(vehicle->all<service_result>().back().what.as<echo>()->number
        >= said - 1);
  const auto local = results(false);
  stand_at(200, 5s);
  CHECK(results(true) <= remote + 1);
  CHECK(results(false) > local + 90);
  const auto changes = vehicle->all<source_change>();
  REQUIRE(changes.size() == 2);
  CHECK(changes[0].service == service_name{"never_heard_of"});
  CHECK(changes[0].remote);
  CHECK(!changes[1].remote);
  const auto episodes = recorder->all<episode_record>();
  REQUIRE(episodes.size() == 2); // one for each side
  for (const auto& e : episodes) {
    CHECK(e.reason == end_reason::left_area);
    CHECK(e.session == episodes.front().session);
  }
  CHECK(episodes[0].of != episodes[1].of);
}

TEST_CASE_FIXTURE(echo_world,
                  "on an ideal link there is a result for every cycle") {
  stand_at(0, 60s);
  CHECK(vehicle->count<source_change>() == 1);
  const auto records = recorder->all<cycle_record>();
  CHECK(records.size() > 1190);
  for (std::size_t k = 2; k < records.size(); ++k)
    CHECK(records[k].interarrival == 50ms);
}
