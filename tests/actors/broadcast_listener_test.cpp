// What a service at a provider hears besides its inputs, and whom it is made
// for.
#include "actors/offloading/broadcast_listener.hpp"

#include "tests/actors/provider_world.hpp"
#include "tests/actors/requester_world.hpp"

#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::planners;
using namespace sofof::test;

namespace {

/// Remembers what it was told.
struct notebook final : broadcast_listener {
  std::vector<cam> heard;
  std::vector<roadside_detections> seen;
  std::vector<sender_id> senders; // of CAMs and CPMs
  std::vector<station_doubt> doubts;

  void on_cam(const cam& c, sender_id from) override {
    heard.push_back(c);
    senders.push_back(from);
  }
  void on_objects(const object_list& told, sender_id from) override {
    seen.push_back({told.at, told.objects});
    senders.push_back(from);
  }
  void on_detections(const roadside_detections& view) override {
    seen.push_back(view);
  }
  std::vector<station_doubt> take_doubts() override {
    return std::exchange(doubts, {});
  }
};

/// What an echo was made for.
struct contexts {
  std::vector<offloading::vehicle_context> vehicles;
  std::vector<offloading::provider_context> providers;
  std::vector<station_id> functions; // at providers, for which vehicle
  std::vector<std::shared_ptr<notebook>> notebooks;
};

/// An echo that listens at a provider.
struct listening_echo final : listening_service {
  std::shared_ptr<contexts> all;
  std::shared_ptr<notebook> own = std::make_shared<notebook>();

  explicit listening_echo(std::shared_ptr<contexts> x) : all{std::move(x)} {
    all->notebooks.push_back(own);
  }
  std::shared_ptr<offloading::service_function>
  make_function(station_id who) override {
    all->functions.push_back(who);
    return std::make_shared<echo_function>();
  }
  broadcast_listener* listener() override { return own.get(); }
};

/// An echo that remembers for whom what was made.
offloading::service knowing_echo(service_name name,
                                 std::shared_ptr<contexts> all) {
  auto service = echo_service(name);
  service.in_vehicle = [all](const offloading::vehicle_context& vehicle) {
    all->vehicles.push_back(vehicle);
    return std::make_shared<echo_in_vehicle>();
  };
  service.at_provider = [all](const offloading::provider_context& provider) {
    all->providers.push_back(provider);
    return std::make_shared<listening_echo>(all);
  };
  return service;
}

/// A provider of three services, the second of which does not listen.
struct listening_world : provider_world {
  std::shared_ptr<contexts> first = std::make_shared<contexts>();
  std::shared_ptr<contexts> third = std::make_shared<contexts>();

  listening_world() {
    provider = own(spawn_service_provider(system(), knowing()));
    settle();
  }

  provider_actor_setup knowing() {
    auto s = setup();
    s.services = {knowing_echo("one", first), echo_service("two"),
                  knowing_echo("three", third)};
    return s;
  }
  notebook& heard() const {
    REQUIRE(first->notebooks.size() == 1);
    return *first->notebooks.front();
  }
};

} // namespace

TEST_CASE_FIXTURE(listening_world, "a provider makes each service that it "
                                   "offers once") {
  REQUIRE(first->providers.size() == 1);
  CHECK(third->providers.size() == 1);
  CHECK(first->providers.front().station == provider_station(0));
  CHECK(first->providers.front().position == point{1, 2});
}

TEST_CASE_FIXTURE(listening_world,
                  "listeners hear every CAM, also from outside and of "
                  "those that use another service") {
  hear(inside);
  hear(outside, neighbour, 102);
  start({two});
  hear(inside);
  auto late = cam{station, now() - 1s, inside, 0, 10, 0};
  hear(late, requester); // overtaken on its way
  REQUIRE(heard().heard.size() == 4);
  CHECK(heard().heard[1].station == 102);
  CHECK(distance_m(heard().heard[1].position, outside) < 0.02);
  CHECK(heard().heard[3].at == late.at);
  CHECK(third->notebooks.front()->heard.size() == 4);
}

TEST_CASE_FIXTURE(listening_world,
                  "listeners see what the provider's sensors see") {
  const roadside_detections view{now(), {{{1, 2}, 0.5, 3, 4, 5, 6}}};
  tell(provider, view);
  REQUIRE(heard().seen.size() == 1);
  CHECK(heard().seen[0].at == view.at);
  REQUIRE(heard().seen[0].objects.size() == 1);
  CHECK(heard().seen[0].objects[0].centre == point{1, 2});
  CHECK(third->notebooks.front()->seen.size() == 1);
}

TEST_CASE_FIXTURE(listening_world,
                  "listeners see what vehicles tell in CPMs, who they "
                  "may be") {
  see(102, {{5, {{30, 20}, 0.5, 3, 0, 5, 2}}});
  REQUIRE(heard().seen.size() == 1);
  CHECK(heard().seen[0].at == now());
  REQUIRE(heard().seen[0].objects.size() == 1);
  CHECK(distance_m(heard().seen[0].objects[0].centre, {30, 20}) < 0.02);
  CHECK(heard().heard.empty());
}

TEST_CASE_FIXTURE(listening_world,
                  "listeners know whose certificate a message came by, "
                  "or that a station stands for itself") {
  hear(inside, neighbour, 102);
  auto message = pdu_of(cam{103, now(), inside, 0, 10, 0});
  message.sender = 77;
  tell(provider, message, neighbour.handle);
  see(102);
  CHECK(heard().senders == std::vector<sender_id>{102, 77, 102});
}

TEST_CASE_FIXTURE(listening_world,
                  "what a listener doubts is recorded, five stations a "
                  "second after the first fifty") {
  const auto doubts = [&](station_id::rep first, station_id::rep count) {
    for (station_id::rep k = 0; k < count; ++k)
      heard().doubts.push_back(
          {now(), first + k, true, doubt_check::sight, 0.35, 0.3});
    hear(inside);
  };
  const auto recorded = [&] {
    std::vector<event_record> all;
    for (const auto& e : recorder->all<event_record>())
      if (e.what == event_type::doubted)
        all.push_back(e);
    return all;
  };
  doubts(201, 1);
  REQUIRE(recorded().size() == 1);
  CHECK(recorded()[0].station == 201);
  CHECK(recorded()[0].provider == boot);
  CHECK(recorded()[0].detail == "sight value=0.350 limit=0.300");
  doubts(300, 100);
  CHECK(recorded().size() == 50);
  run_for(1s);
  doubts(500, 100);
  CHECK(recorded().size() == 55);
}

TEST_CASE_FIXTURE(listening_world, "all functions of a service are made where "
                                   "it listens, each for its vehicle") {
  hear(inside);
  codm->accepted.insert("three");
  start({one, {"three"}});
  hear(inside, neighbour, 102);
  tell(provider, service_request{boot, 102, 1, {one}, {inside}, 10},
       neighbour.handle);
  CHECK(first->functions == std::vector<station_id>{station, 102});
  CHECK(third->functions == std::vector<station_id>{station});
  CHECK(first->providers.size() == 1);
}

TEST_CASE_FIXTURE(listening_world, "a service at a provider is told the time") {
  run_for(70ms);
  CHECK(first->providers.back().clock() == now());
}

TEST_CASE_FIXTURE(requester_world, "in a vehicle a service is told whose it is "
                                   "and the time") {
  const auto all = std::make_shared<contexts>();
  auto s = setup();
  s.services = {{knowing_echo("one", all)}};
  own(spawn_service_requester(system(), std::move(s)));
  run_for(70ms);
  CHECK(all->providers.empty());
  REQUIRE(all->vehicles.size() == 1);
  CHECK(all->vehicles.front().station == station);
  CHECK(all->vehicles.front().clock() == now());
}
