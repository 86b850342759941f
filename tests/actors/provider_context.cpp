// What a provider knows beyond one vehicle's input: its services' sites.
#include "tests/actors/provider_world.hpp"
#include "tests/actors/requester_world.hpp"

#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::test;

namespace {

/// Remembers what it was told.
struct notebook final : provider_context {
  std::vector<cam> heard;
  std::vector<roadside_detections> seen;
  std::vector<sender_id> senders; // of CAMs and CPMs
  std::vector<station_doubt> doubts;

  void hear(const cam& c, sender_id from) override {
    heard.push_back(c);
    senders.push_back(from);
  }
  void hear(const object_list& told, sender_id from) override {
    seen.push_back({told.at, told.objects});
    senders.push_back(from);
  }
  void see(const roadside_detections& view) override { seen.push_back(view); }
  std::vector<station_doubt> news() override {
    return std::exchange(doubts, {});
  }
};

/// An echo with a site, that remembers for whom what was made.
class knowing_echo final : public service_type {
public:
  explicit knowing_echo(std::string name) : echo_{std::move(name)} {
    common = echo_.common;
  }

  std::string_view name() const override { return echo_.name(); }

  std::shared_ptr<service_function>
  make_function(const service_setup& setup) const override {
    functions->push_back(setup);
    return echo_.make_function(setup);
  }
  client_actor spawn_client(caf::actor_system&, const service_setup& setup,
                            const vehicle_actor& vehicle) const override {
    clients->push_back(setup);
    return vehicle;
  }
  std::shared_ptr<provider_context>
  make_site(const service_setup& setup) const override {
    made->push_back(setup);
    sites->push_back(std::make_shared<notebook>());
    return sites->back();
  }

  using setups = std::shared_ptr<std::vector<service_setup>>;
  setups functions = std::make_shared<std::vector<service_setup>>();
  setups clients = std::make_shared<std::vector<service_setup>>();
  setups made = std::make_shared<std::vector<service_setup>>();
  std::shared_ptr<std::vector<std::shared_ptr<notebook>>> sites =
      std::make_shared<std::vector<std::shared_ptr<notebook>>>();

private:
  echo_service echo_;
};

/// A provider of three kinds, the second of which has no site.
struct site_world : provider_world {
  std::shared_ptr<knowing_echo> first = std::make_shared<knowing_echo>("one");
  std::shared_ptr<knowing_echo> third = std::make_shared<knowing_echo>("three");

  site_world() {
    provider = own(spawn_service_provider(system(), knowing()));
    settle();
  }

  provider_setup knowing() {
    auto s = setup();
    s.kinds = {first, std::make_shared<echo_service>("two"), third};
    return s;
  }
  notebook& first_site() const {
    REQUIRE(first->sites->size() == 1);
    return *first->sites->front();
  }
  const notebook& site() const { return first_site(); }
};

} // namespace

TEST_CASE_FIXTURE(site_world, "a provider makes one site per kind it offers") {
  CHECK(first->made->size() == 1);
  CHECK(third->made->size() == 1);
  const auto& made = first->made->front();
  CHECK(made.remote);
  CHECK(made.world);
  CHECK_FALSE(made.site);
  CHECK_FALSE(echo_service{"two"}.make_site({}));
}

TEST_CASE_FIXTURE(site_world, "sites hear every CAM, also from outside and of "
                              "those that use another service") {
  hear(inside);
  hear(outside, neighbour, 102);
  start({two});
  hear(inside);
  auto late = cam{station, now() - 1s, inside, 0, 10, 0};
  hear(late, requester); // overtaken on its way
  REQUIRE(site().heard.size() == 4);
  CHECK(site().heard[1].station == 102);
  CHECK(distance_m(site().heard[1].position, outside) < 0.02);
  CHECK(site().heard[3].at == late.at);
  CHECK(third->sites->front()->heard.size() == 4);
}

TEST_CASE_FIXTURE(site_world, "sites see what the provider's sensors see") {
  const roadside_detections view{now(), {{{1, 2}, 0.5, 3, 4, 5, 6}}};
  tell(provider, view);
  REQUIRE(site().seen.size() == 1);
  CHECK(site().seen[0].at == view.at);
  REQUIRE(site().seen[0].objects.size() == 1);
  CHECK(site().seen[0].objects[0].centre == point{1, 2});
  CHECK(third->sites->front()->seen.size() == 1);
}

TEST_CASE_FIXTURE(site_world, "sites see what vehicles tell in CPMs, who they "
                              "may be") {
  see(102, {{5, {{30, 20}, 0.5, 3, 0, 5, 2}}});
  REQUIRE(site().seen.size() == 1);
  CHECK(site().seen[0].at == now());
  REQUIRE(site().seen[0].objects.size() == 1);
  CHECK(distance_m(site().seen[0].objects[0].centre, {30, 20}) < 0.02);
  CHECK(site().heard.empty());
}

TEST_CASE_FIXTURE(site_world, "sites know whose certificate a message came by, "
                              "or that a station stands for itself") {
  hear(inside, neighbour, 102);
  auto message = pdu_of(cam{103, now(), inside, 0, 10, 0});
  message.sender = 77;
  tell(provider, message, neighbour.handle);
  see(102);
  CHECK(site().senders == std::vector<sender_id>{102, 77, 102});
}

TEST_CASE_FIXTURE(site_world, "what a site doubts is recorded, five stations a "
                              "second after the first fifty") {
  const auto doubts = [&](station_id first, station_id count) {
    for (station_id k = 0; k < count; ++k)
      first_site().doubts.push_back(
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

TEST_CASE_FIXTURE(site_world, "all functions of a kind at a provider share "
                              "its site, and no other") {
  hear(inside);
  codm->accepted.insert("three");
  start({one, {"three"}});
  hear(inside, neighbour, 102);
  tell(provider, service_request{boot, 102, 1, {one}, {inside}, 10},
       neighbour.handle);
  REQUIRE(first->functions->size() == 2);
  REQUIRE(third->functions->size() == 1);
  CHECK((*first->functions)[0].site == first->sites->front());
  CHECK((*first->functions)[1].site == first->sites->front());
  CHECK((*third->functions)[0].site == third->sites->front());
  CHECK((*first->functions)[0].remote);
}

TEST_CASE_FIXTURE(site_world, "a function at a provider is told the time") {
  hear(inside);
  start({one});
  run_for(70ms);
  CHECK(first->functions->back().clock() == now());
}

TEST_CASE_FIXTURE(requester_world, "in a vehicle there are no sites, but "
                                   "a clock") {
  const auto kind = std::make_shared<knowing_echo>("one");
  auto s = setup();
  s.kinds = {kind};
  own(spawn_service_requester(system(), std::move(s)));
  run_for(70ms);
  CHECK(kind->made->empty());
  REQUIRE(kind->functions->size() == 1);
  REQUIRE(kind->clients->size() == 1);
  for (const auto& made : {kind->functions->front(), kind->clients->front()}) {
    CHECK_FALSE(made.site);
    CHECK_FALSE(made.remote);
    CHECK(made.clock() == now());
  }
}
