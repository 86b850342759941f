// The promises of the offloading protocol, under loss, delay, duplicates,
// reordering and crashes.
#include "base/protocol.hpp"

#include "actors/offloading/service_provider.hpp"
#include "actors/offloading/service_requester.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/simulation/network_link.hpp"
#include "messages/v2x/cam_content.hpp"
#include "messages/v2x/encoded.hpp"
#include "policies/registry.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/toy_streets.hpp"
#include "tests/support/virtual_world.hpp"

#include <caf/stateful_actor.hpp>
#include <doctest/doctest.h>

#include <map>
#include <optional>
#include <set>

using namespace sofof;
using namespace sofof::test;

namespace {

constexpr station_id station = 101;

/// In Ulm-Lehr, in 2026.
georeference_ptr somewhere() {
  static const auto where = std::make_shared<const georeference>();
  return where;
}

/// What one vehicle's client lives through; every promise is checked at every
/// message.
struct client_diary {
  struct entry {
    bool remote = false;
    time_point newest_created;
    time_point newest_of_source; // in use now
    bool any_result = false;
  };
  std::map<service_name, entry> services;
  std::vector<std::string> broken; // promises

  void take(const source_change& change) {
    auto& e = services[change.kind];
    if (e.remote == change.remote)
      broken.push_back("a source was chosen that was in use already");
    e.remote = change.remote;
    e.newest_of_source = {};
  }

  void take(const service_result& result) {
    auto& e = services[result.running.kind];
    if (e.remote != (result.running.counter != 0))
      broken.push_back("a result came from the source that is not in use");
    if (result.created < e.newest_of_source)
      broken.push_back("a source's results came out of order");
    e.newest_of_source = result.created;
    e.newest_created = std::max(e.newest_created, result.created);
    e.any_result = true;
  }
};

using moving_client = vehicle_actor::extend<reacts_to<tick_atom>>;

struct client_state {
  static inline const char* name = "moving_client";
  std::vector<requester_manager_actor> managers;
  onboard_requester_actor requester;
  double x_m = -500;
  std::uint64_t said = 0;
};

/// A vehicle reduced to what the protocol needs: drives to and fro over the
/// area at 15 m/s, sends CAMs at 10 Hz, feeds its services at 20 Hz.
moving_client::behavior_type
drive(moving_client::stateful_pointer<client_state> self,
      std::shared_ptr<client_diary> diary, std::vector<link_actor> links,
      requester_setup* setup) {
  setup->vehicle = vehicle_actor{self};
  self->state.requester =
      spawn_service_requester(self->system(), std::move(*setup));
  self->set_exit_handler([self](const caf::exit_msg& e) {
    self->send_exit(self->state.requester, e.reason);
    self->quit(e.reason);
  });
  self->send(self, tick_atom_v);
  return {
      [diary](const service_result& result) { diary->take(result); },
      [diary](const source_change& change) { diary->take(change); },
      [self](const requester_manager_actor& manager) {
        self->state.managers.push_back(manager);
      },
      [](const perception&) {},
      [](begin_atom) {},
      [self, links](tick_atom) {
        auto& s = self->state;
        const auto t = now(self);
        send_at(self, self, t + 50ms, tick_atom_v);
        s.x_m += 0.75;
        if (s.x_m > 500)
          s.x_m = -500;
        ++s.said;
        for (const auto& manager : s.managers)
          self->send(manager, service_input{{}, t, payload::of(echo{s.said})});
        if (s.said % 2 == 0)
          return;
        const cam own{station, t, {s.x_m, 0}, 0, 15, 0};
        self->send(s.requester, ego_state{own, s.x_m + 500});
        for (const auto& link : links)
          self->send(link, encoded(make_cam(own, {}, *somewhere())),
                     requester_actor{s.requester});
      },
  };
}

/// Counts how often each side closed each running service.
struct ledger final : record_sink {
  std::map<session_id, int> closed_by_requester, closed_by_provider;
  std::map<session_id, duration> provider_side; // how long it ran
  std::set<end_reason> reasons;
  int remote_episodes = 0;

  void take(const event_record&) override {}
  void take(const decision_record&) override {}
  void take(const cycle_record&) override {}
  void take(const episode_record& r) override {
    ++(r.of == side::requester ? closed_by_requester
                               : closed_by_provider)[r.running];
    reasons.insert(r.reason);
    if (r.of == side::provider)
      provider_side[r.running] = r.ended - r.accepted;
    if (r.of == side::requester)
      remote_episodes += r.got_data;
  }
  void take(const track_record&) override {}
  void take(const safety_record&) override {}
  void take(const collision_record&) override {}
  void take(const drive_record&) override {}
  void take(const plan_switch_record&) override {}
  void take(const air_record&) override {}
};

streets_ptr one_street() {
  auto world = std::make_shared<streets>();
  world->map =
      road_map{"street", {}, {toy::straight("street", {-600, 0}, {1400, 0})}};
  world->routes.push_back(world->map.make_route(
      "street", std::vector<std::string>{"street"}, false));
  return world;
}

struct faulty_world : virtual_world {
  std::uint64_t seed;
  link_fault_options faults;
  streets_ptr world = one_street();
  std::vector<service_type_ptr> kinds{std::make_shared<echo_service>("one"),
                                      std::make_shared<echo_service>("two")};
  std::shared_ptr<ledger> book = std::make_shared<ledger>();
  recorder_actor recorder = own(spawn_recorder(system(), book));
  std::shared_ptr<const channel_profile> profile =
      std::make_shared<channel_profile>(*find_channel_profile("paper-5g"));
  std::shared_ptr<client_diary> diary = std::make_shared<client_diary>();
  std::vector<provider_actor> providers;
  std::vector<link_actor> links;
  moving_client vehicle;

  faulty_world(std::uint64_t seed, link_fault_options faults,
               int provider_count)
      : seed{seed}, faults{faults} {
    for (int k = 0; k < provider_count; ++k)
      add_provider(k);
    requester_setup setup;
    setup.where = somewhere();
    setup.station = station;
    setup.way = world->routes.front();
    setup.world = world;
    setup.kinds = kinds;
    setup.lodm = make_lodm("always");
    setup.recorder = recorder;
    setup.noise = random_stream{seed, "vehicle"};
    vehicle = system().spawn(drive, diary, links, &setup);
    settle();
  }

  void add_provider(int k) {
    provider_setup setup;
    setup.boot = static_cast<provider_id>(k + 1);
    setup.where = somewhere();
    setup.area = polygon::regular({100.0 * k, 0}, 300, 24);
    setup.world = world;
    setup.kinds = kinds;
    setup.codm = make_codm("always");
    setup.recorder = recorder;
    setup.profile = profile;
    setup.seed = random_stream{seed, "network"};
    setup.number = static_cast<std::uint32_t>(k);
    providers.push_back(spawn_service_provider(system(), std::move(setup)));
    const channel draws{profile, random_stream{seed, "network"}, station,
                        static_cast<std::uint32_t>(k)};
    links.push_back(spawn_network_link(
        system(), providers.back(),
        {{draws, way::up, nullptr},
         {draws, way::down, nullptr},
         link_faults{random_stream{seed, "faults"}.part(providers.size()),
                     faults}}));
  }

  ~faulty_world() {
    caf::anon_send_exit(vehicle, caf::exit_reason::user_shutdown);
    for (const auto& p : providers)
      caf::anon_send_exit(p, caf::exit_reason::user_shutdown);
    for (const auto& l : links)
      caf::anon_send_exit(l, caf::exit_reason::user_shutdown);
    settle();
  }

  /// Runs on, and checks every 10 ms that the newest result is fresh.
  void run_and_check(duration d) {
    constexpr auto fresh = 50ms + 100ms + 50ms;
    for (const auto end = now() + d; now() < end;) {
      run_for(10ms);
      for (const auto& [kind, e] : diary->services)
        if (e.any_result && now() - e.newest_created > fresh)
          diary->broken.push_back("the newest result is not fresh");
    }
  }

  void check_ledger() {
    for (const auto& [running, times] : book->closed_by_requester)
      CHECK(times == 1);
    for (const auto& [running, times] : book->closed_by_provider)
      CHECK(times == 1);
    // What the requester ran, the provider ran too, and has closed as well.
    for (const auto& [running, times] : book->closed_by_requester)
      CHECK(book->closed_by_provider.contains(running));
  }
};

/// Drives a world through its faults, then dismisses everybody.
void live(std::uint64_t seed, const link_fault_options& faults,
          int provider_count, std::optional<duration> crash_at,
          std::shared_ptr<ledger>& book) {
  CAPTURE(seed);
  std::shared_ptr<client_diary> diary;
  {
    faulty_world w{seed, faults, provider_count};
    book = w.book;
    diary = w.diary;
    if (crash_at) {
      w.run_and_check(*crash_at);
      w.kill(w.providers.front());
      w.run_and_check(60s);
    } else {
      w.run_and_check(200s);
    }
    CHECK(diary->services.size() == 2);
    for (const auto& text : diary->broken)
      FAIL_CHECK(text);
    if (!crash_at) {
      caf::anon_send_exit(w.vehicle, caf::exit_reason::user_shutdown);
      for (const auto& p : w.providers)
        caf::anon_send_exit(p, caf::exit_reason::user_shutdown);
      w.settle();
      w.check_ledger();
    }
  }
  for (const auto& [running, times] : book->closed_by_requester)
    CHECK(times == 1);
}

} // namespace

TEST_CASE("on a good link a vehicle offloads at every passage, and both sides "
          "close each episode once") {
  std::shared_ptr<ledger> book;
  live(1, {}, 1, std::nullopt, book);
  CHECK(book->remote_episodes >= 6); // two kinds, three passages in 200 s
  CHECK(book->reasons.contains(end_reason::left_area));
}

TEST_CASE("whatever a link loses, doubles, delays and reorders: one source, "
          "always a fresh result, every episode ends once") {
  dice random{4711};
  int episodes = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const link_fault_options faults{
        random.between(0, 0.4), random.between(0, 0.4), random.between(0, 0.4),
        from_seconds(random.between(0.001, 2.0))};
    std::shared_ptr<ledger> book;
    live(seed, faults, 1 + static_cast<int>(seed % 3), std::nullopt, book);
    episodes += book->remote_episodes;
  }
  CHECK(episodes > 500); // faults did not keep everybody local
}

TEST_CASE("when the provider crashes, its vehicles go on locally at once") {
  dice random{815};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::shared_ptr<ledger> book;
    live(seed, {}, 1, from_seconds(random.between(5, 60)), book);
  }
}

TEST_CASE("when a vehicle crashes, its provider closes what it ran for it") {
  dice random{2020};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    faulty_world w{seed, {}, 1};
    w.run_and_check(from_seconds(random.between(15, 50))); // in the area
    w.kill(w.vehicle);
    w.run_for(5s); // longer than the CAM check takes
    CHECK(w.book->closed_by_provider.size() >= 2);
    for (const auto& [running, times] : w.book->closed_by_provider)
      CHECK(times == 1);
  }
}

TEST_CASE("a lost message costs seconds of offloading, not a passage") {
  // What the provider runs and the requester does not know of blocks offers.
  duration blocked{}, longest{};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const link_fault_options faults{0.1, 0, 0, {}};
    faulty_world w{seed, faults, 1};
    w.run_for(200s);
    caf::anon_send_exit(w.vehicle, caf::exit_reason::user_shutdown);
    w.settle();
    for (const auto& [running, lasted] : w.book->provider_side)
      if (!w.book->closed_by_requester.contains(running)) {
        blocked += lasted;
        longest = std::max(longest, lasted);
      }
  }
  CHECK(blocked > 0ns); // responses were lost
  CHECK(longest <= protocol::start_timeout + 1ms);
}
