// Vehicles and their provider on two hosts, with a wire between them, in
// virtual time.
#pragma once

#include "actors/offloading/service_provider.hpp"
#include "actors/offloading/service_requester.hpp"
#include "actors/remote/acceptor.hpp"
#include "actors/remote/provider_connection.hpp"
#include "actors/remote/provider_proxy.hpp"
#include "tests/actors/spy_policies.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/toy_streets.hpp"
#include "tests/support/virtual_world.hpp"
#include "tests/support/wire.hpp"
#include "world/roads/streets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sofof::test {

struct remote_world : virtual_world {
  static constexpr provider_id::rep first_boot = 11;

  /// A vehicle that stands still and wants its services run elsewhere.
  struct car {
    station_id::rep station = 0;
    probe<messages::vehicle_actor> vehicle;
    messages::link_actor far;
    messages::onboard_requester_actor requester;
    std::vector<messages::requester_manager_actor> managers;
  };

  const messages::service_name one{"one"}, two{"two"};
  probe<messages::recorder_actor> here = listen<messages::recorder_actor>();
  probe<messages::recorder_actor> there = listen<messages::recorder_actor>();
  wire_ptr line = std::make_shared<wire>();
  world::streets_ptr world = one_street();
  std::shared_ptr<lodm_script> lodm = std::make_shared<lodm_script>();
  std::shared_ptr<codm_script> codm = std::make_shared<codm_script>();
  provider_id::rep boot = first_boot - 1;
  messages::roadside_provider_actor provider;
  messages::acceptor_actor inner_acceptor; ///< Of the provider.
  /// With the wire; none while its host is down.
  messages::acceptor_actor acceptor;
  actors::provider_outbox outbox;
  std::vector<time_point> attempts;
  std::vector<std::string> news, refusals;
  std::vector<car> cars;
  std::uint64_t said = 0;
  duration cam_period = 100ms;

  explicit remote_world(std::size_t count = 1) {
    run_for(10s); // the clock's zero is no special time
    boot_up();
    outbox = own(
        actors::spawn_provider_connection(system(), make_connection(count)));
    for (std::size_t k = 0; k < count; ++k)
      add_car(static_cast<station_id::rep>(101 + k));
    settle();
  }

  static world::streets_ptr one_street() {
    auto world = std::make_shared<world::streets>();
    world->map = world::road_map{
        "street", {}, {toy::straight("street", {0, 0}, {2000, 0})}};
    world->routes.push_back(world->map.make_route(
        "street", std::vector<std::string>{"street"}, false));
    return world;
  }
  static std::vector<offloading::service> services() {
    return {echo_service("one"), echo_service("two")};
  }

  actors::provider_connection_setup make_connection(std::size_t count) {
    actors::provider_connection_setup s;
    s.provider = "server";
    s.address = [] { return "10.0.0.5:4711"; };
    for (std::size_t k = 0; k < count; ++k)
      s.stations.push_back(static_cast<station_id::rep>(101 + k));
    s.recorder = here.handle;
    s.noise = random_stream{1, "connection"};
    s.connect =
        [this]() -> std::variant<messages::acceptor_actor, std::string> {
      attempts.push_back(now());
      if (acceptor && !line->cut)
        return acceptor;
      return "nobody is there";
    };
    s.aside = [](const std::function<void()>& attempt) { attempt(); };
    s.prove = [](messages::peer_hello& hello, const std::string&) {
      hello.certificate = "honest";
    };
    s.on_refusal = [this](const std::string& why) { refusals.push_back(why); };
    s.on_news = [this](const std::string& what) { news.push_back(what); };
    return s;
  }

  void add_car(station_id::rep station) {
    car c{station,
          listen<messages::vehicle_actor>(),
          own(actors::spawn_provider_proxy(system(), station, outbox)),
          {},
          {}};
    actors::introduce(outbox, station, c.far);
    actors::requester_actor_setup setup;
    setup.station = station;
    setup.path_ahead = toy::path_ahead_on(world->routes.front());
    for (auto& service : services())
      setup.services.push_back({std::move(service)});
    setup.lodm = std::make_unique<spy_lodm>(lodm);
    setup.vehicle = c.vehicle.handle;
    setup.recorder = here.handle;
    setup.noise = random_stream{station, "vehicle"};
    c.requester =
        own(actors::spawn_service_requester(system(), std::move(setup)));
    settle();
    c.managers = c.vehicle->all<messages::requester_manager_actor>();
    cars.push_back(std::move(c));
  }

  // -- what happens to the hosts ----------------------------------------------

  /// The provider's host starts, anew.
  void boot_up() {
    actors::provider_actor_setup s;
    s.id = ++boot;
    s.position = {1000, 0};
    s.area = polygon{{{-100, -100}, {3000, -100}, {3000, 100}, {-100, 100}}};
    s.map = {world, &world->map};
    s.decode = decode_in_ulm();
    s.services = services();
    s.codm = std::make_unique<spy_codm>(codm);
    s.recorder = there.handle;
    s.seed = random_stream{1, "network"};
    provider = own(actors::spawn_service_provider(system(), std::move(s)));
    actors::acceptor_setup g;
    g.provider = provider;
    g.id = boot;
    g.name = "server";
    g.recorder = there.handle;
    g.draw_nonce = [] { return std::string{"number"}; };
    g.examine = [](const messages::peer_hello& hello, const std::string&,
                   const caf::node_id&) -> actors::peer_finding {
      if (hello.certificate == "honest")
        return {"honest", {}};
      return {{}, "nobody knows it"};
    };
    inner_acceptor = own(actors::spawn_acceptor(system(), std::move(g)));
    acceptor = own(system().spawn(wired_acceptor, inner_acceptor, line));
  }
  /// It dies, and all its actors with it.
  void crash() {
    const auto dying = std::exchange(acceptor, nullptr);
    kill(dying);
    kill(inner_acceptor);
    kill(provider);
  }

  /// Vehicles stand where they are, say so and want plans.
  void drive(duration d) {
    for (auto left = d; left >= 50ms; left -= 50ms) {
      run_for(50ms);
      ++said;
      for (const auto& c : cars)
        step(c);
    }
  }
  void step(const car& c) {
    for (const auto& m : c.managers)
      tell(m, messages::service_input{
                  {}, now(), messages::payload::of(echo{said})});
    if (said % 2 == 0)
      return;
    const messages::cam own{c.station, now(), {500, 0}, 0, 10, 0};
    tell(c.requester, messages::ego_state{own, 500});
    if (said % static_cast<std::uint64_t>(cam_period / 50ms) == 1)
      tell(c.far, pdu_of(own), messages::requester_actor{c.requester});
  }

  // -- what came of it --------------------------------------------------------

  /// @returns whether a service of a vehicle is run elsewhere now.
  static bool is_remote(const car& c, const messages::service_name& kind) {
    bool remote = false;
    for (const auto& change : c.vehicle->all<messages::source_change>())
      if (change.service == kind)
        remote = change.remote;
    return remote;
  }
  bool all_remote() const {
    return std::ranges::all_of(cars, [this](const car& c) {
      return is_remote(c, one) && is_remote(c, two);
    });
  }
  bool none_remote() const {
    return std::ranges::none_of(cars, [this](const car& c) {
      return is_remote(c, one) || is_remote(c, two);
    });
  }
  static std::vector<messages::service_result> remote_results(const car& c) {
    std::vector<messages::service_result> found;
    for (const auto& r : c.vehicle->all<messages::service_result>())
      if (r.session.is_remote())
        found.push_back(r);
    return found;
  }
  static std::vector<messages::episode_record>
  episodes(const probe<messages::recorder_actor>& at) {
    return at->all<messages::episode_record>();
  }
  static std::vector<messages::event_record>
  notes(const probe<messages::recorder_actor>& at, std::string_view what) {
    std::vector<messages::event_record> found;
    for (const auto& e : at->all<messages::event_record>())
      if (messages::name_of(e.what) == what)
        found.push_back(e);
    return found;
  }
};

} // namespace sofof::test
