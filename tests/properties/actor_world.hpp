// One vehicle and its providers, over faulty links, as actors.
#pragma once

#include "actors/offloading/service_provider.hpp"
#include "actors/offloading/service_requester.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/simulation/network_link.hpp"
#include "messages/protocol/no_records.hpp"
#include "messages/v2x/cam_content.hpp"
#include "messages/v2x/encoded.hpp"
#include "tests/properties/ledger.hpp"
#include "tests/support/virtual_world.hpp"

#include <caf/stateful_actor.hpp>

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::test {

/// In Ulm-Lehr, in 2026.
inline messages::georeference_ptr somewhere() {
  static const auto where = std::make_shared<const messages::georeference>();
  return where;
}

using moving_client =
    messages::vehicle_actor::extend<messages::reacts_to<messages::tick_atom>>;

struct moving_client_state {
  static inline const char* name = "moving_client";
  std::vector<messages::requester_manager_actor> managers;
  messages::onboard_requester_actor requester;
  shuttle car;
};

inline moving_client::behavior_type
drive(moving_client::stateful_pointer<moving_client_state> self,
      std::shared_ptr<client_diary> diary,
      std::vector<messages::link_actor> links,
      actors::requester_actor_setup* setup) {
  setup->vehicle = messages::vehicle_actor{self};
  self->state.requester =
      actors::spawn_service_requester(self->system(), std::move(*setup));
  self->set_exit_handler([self](const caf::exit_msg& e) {
    self->send_exit(self->state.requester, e.reason);
    self->quit(e.reason);
  });
  self->send(self, messages::tick_atom_v);
  return {
      [diary](const messages::service_result& result) {
        diary->on_result(result);
      },
      [diary](const messages::source_change& change) {
        diary->on_source(change.service, change.remote);
      },
      [self](const messages::requester_manager_actor& manager) {
        self->state.managers.push_back(manager);
      },
      [](const messages::crossing_driver_actor&) {},
      [](std::uint32_t, const messages::chain_stage_actor&) {},
      [](const messages::payload&) {},
      [](const messages::its_pdu&) {},
      [](const world::perception&) {},
      [](messages::begin_atom) {},
      [self, links](messages::tick_atom) {
        auto& s = self->state;
        const auto t = actors::now(self);
        actors::send_at(self, self, t + 50ms, messages::tick_atom_v);
        s.car.step();
        const auto said = messages::payload::of(echo{s.car.said});
        for (const auto& manager : s.managers)
          self->send(manager, messages::service_input{{}, t, said});
        if (!s.car.sends_cam())
          return;
        const auto ego = s.car.ego(t);
        self->send(s.requester, ego);
        for (const auto& link : links)
          self->send(
              link,
              messages::encoded(messages::make_cam(ego.own, {}, *somewhere())),
              messages::requester_actor{s.requester});
      },
  };
}

/// Gives episodes to a ledger, and steps to a diary.
struct ledger_sink final : messages::record_sink {
  std::shared_ptr<ledger> book;
  std::shared_ptr<client_diary> diary;
  ledger_sink(std::shared_ptr<ledger> x, std::shared_ptr<client_diary> y)
      : book{std::move(x)}, diary{std::move(y)} {}
  void on_record(const messages::record& x) override {
    book->on_record(x);
    diary->on_record(x);
  }
};

struct actor_world : virtual_world {
  static constexpr std::string_view kind = "actors";

  std::uint64_t seed;
  channel::link_fault_options faults;
  conduct of;
  world::streets_ptr world = one_long_street();
  std::shared_ptr<ledger> book = std::make_shared<ledger>();
  std::shared_ptr<client_diary> diary = std::make_shared<client_diary>();
  messages::recorder_actor recorder = own(actors::spawn_recorder(
      system(), std::make_shared<ledger_sink>(book, diary)));
  std::shared_ptr<const channel::channel_profile> profile;
  std::vector<messages::provider_actor> providers;
  std::vector<messages::link_actor> links;
  moving_client vehicle;

  actor_world(std::uint64_t seed, channel::link_fault_options faults,
              int provider_count, std::string_view channel = "paper_5g",
              const conduct& how = {})
      : seed{seed}, faults{faults}, of{how}, profile{of.on(channel)} {
    for (int k = 0; k < provider_count; ++k)
      add_provider(k);
    actors::requester_actor_setup setup;
    setup.station = shuttle::station;
    setup.path_ahead = path_ahead;
    setup.services = {{of.service("one")}, {of.service("two")}};
    setup.lodm = of.policy();
    setup.recorder = recorder;
    setup.noise = random_stream{seed, "vehicle"};
    setup.trace = true;
    vehicle = system().spawn(drive, diary, links, &setup);
    settle();
  }

  void add_provider(int k) {
    actors::provider_actor_setup setup;
    setup.id = static_cast<provider_id>(k + 1);
    setup.decode = [where = somewhere()](const messages::its_pdu& message,
                                         time_point now) {
      return messages::decode(message, *where, now);
    };
    setup.area = area_of_provider(k);
    setup.map = {world, &world->map};
    setup.services = {of.service("one"), of.service("two")};
    setup.codm = of.provider_policy();
    setup.recorder = recorder;
    setup.compute = channel::compute_measured_with(profile->name);
    setup.seed = random_stream{seed, "network"};
    setup.number = static_cast<std::uint32_t>(k);
    setup.trace = true;
    providers.push_back(
        actors::spawn_service_provider(system(), std::move(setup)));
    const channel::channel_draws draws{profile, random_stream{seed, "network"},
                                       shuttle::station,
                                       static_cast<std::uint32_t>(k)};
    links.push_back(actors::spawn_network_link(
        system(), providers.back(),
        {{{draws, channel::direction::up, nullptr}},
         {{draws, channel::direction::down, nullptr}},
         channel::link_faults{
             random_stream{seed, "faults"}.part(providers.size()), faults}}));
  }

  ~actor_world() { dismiss(); }

  /// Everybody leaves in good order.
  void dismiss() {
    dismiss_vehicle();
    for (const auto& p : providers)
      caf::anon_send_exit(p, caf::exit_reason::user_shutdown);
    for (const auto& l : links)
      caf::anon_send_exit(l, caf::exit_reason::user_shutdown);
    settle();
  }
  void dismiss_vehicle() {
    caf::anon_send_exit(vehicle, caf::exit_reason::user_shutdown);
    settle();
  }

  void crash_provider() { kill(providers.front()); }
  void crash_vehicle() { kill(vehicle); }

  /// Runs on, and checks every 10 ms that the newest result is fresh.
  void run_and_check(duration d) {
    for (const auto end = now() + d; now() < end;) {
      run_for(10ms);
      diary->check_fresh(now());
    }
  }
};

} // namespace sofof::test
