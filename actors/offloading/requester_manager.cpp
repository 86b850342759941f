// Service management in the vehicle: mailbox, watchdog and own instance of a
// service whose source offloading/source_selector chooses.
#include "actors/offloading/qos_watchdog.hpp"
#include "actors/offloading/service_manager.hpp"
#include "actors/runtime/cpu_accounts.hpp"
#include "actors/runtime/on_air.hpp"
#include "actors/runtime/time.hpp"
#include "offloading/source_selector.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace sofof {

namespace {

// Besides its interface: the selector's timer with this number.
using requester_manager_impl =
    requester_manager_actor::extend<reacts_to<tick_atom, std::uint64_t>>;

struct requester_manager_state : offloading::selector_port {
  static inline const char* name = "requester_manager";

  requester_manager_impl::stateful_pointer<requester_manager_state> self;
  requester_manager_setup setup;
  std::optional<offloading::source_selector> selector;
  std::map<session_id, provider_manager_actor> managers;
  instance_actor local;
  watchdog_actor watchdog;

  void start() {
    const auto& options = setup.options;
    selector.emplace(
        offloading::selected_service{setup.station, setup.kind, options.limits,
                                     options.period, options.input_period,
                                     setup.record_margins, setup.on_air,
                                     setup.continues},
        *this);
    setup.local.running = {0, setup.station, setup.kind, 0};
    local = spawn_instance(self->system(), {setup.local, self});
    self->link_to(local);
    watchdog =
        spawn_qos_watchdog(self->system(), options.limits, setup.requester);
    self->link_to(watchdog);
    charge_all();
    self->send(local, lifecycle_step::configure);
    self->send(local, lifecycle_step::activate);
    self->send(setup.client, requester_manager_actor{self});
  }

  // For whom they work, in case accounts are kept.
  void charge_all() {
    const cpu_account to{setup.station, setup.kind, selector->is_remote()};
    for (const auto who : {self->id(), local.id(), watchdog.id()})
      charge(self->system(), who, to);
  }

  void on_session(const session_id& session, provider_manager_actor manager) {
    managers[session] = std::move(manager);
    selector->on_session(session, setup.make_judge(), now(self));
  }

  void on_end(const service_end& end) {
    selector->on_end(end, now(self));
    managers.erase(end.running);
  }

  // -- what the selector wants ------------------------------------------------

  void feed_local(const service_input& input) override {
    self->send(local, input);
  }
  void feed_remote(service_input input) override {
    note_on_air(self, setup.recorder, input.what);
    const auto& manager = managers.at(input.running);
    self->send(manager, std::move(input));
  }
  void use(const service_result& result) override {
    self->send(setup.client, result);
  }

  void go_remote() override {
    charge_all();
    self->send(local, lifecycle_step::deactivate);
  }
  void go_local(service_input input) override {
    charge_all();
    self->send(local, std::move(input));
    self->send(local, lifecycle_step::activate);
  }
  void announce_source(bool remote) override {
    self->send(setup.client, source_change{setup.kind, remote});
  }

  void report_first_data(const session_id& session) override {
    self->send(setup.requester, session);
  }
  void report(qos_violation violation) override {
    self->send(setup.requester, std::move(violation));
  }

  void watch(const session_id& session, time_point last) override {
    self->send(watchdog, session, last);
  }
  void watch_arrival(const arrival& result) override {
    self->send(watchdog, result);
  }
  void watch_useless(const session_id& session,
                     const std::string& why) override {
    self->send(watchdog, session, why);
  }
  void watch_end(const service_end& end) override { self->send(watchdog, end); }

  void record(cycle_record x) override {
    self->send(setup.recorder, std::move(x));
  }
  void record(event_record x) override {
    self->send(setup.recorder, std::move(x));
  }

  void wake_at(time_point t, std::uint64_t number) override {
    send_at(self, self, t, tick_atom_v, number);
  }
};

requester_manager_impl::behavior_type requester_manager(
    requester_manager_impl::stateful_pointer<requester_manager_state> self,
    requester_manager_setup setup) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  self->state.start();
  return {
      [self](const service_result& result) {
        self->state.selector->on_result(result, now(self));
      },
      [self](service_input& input) {
        self->state.selector->on_input(std::move(input), now(self));
      },
      [self](const session_id& session, provider_manager_actor& manager) {
        self->state.on_session(session, std::move(manager));
      },
      [self](provider_id provider, duration after) {
        std::optional<offloading::standby> chosen;
        if (provider != 0)
          chosen = {provider, after};
        self->state.selector->on_standby(chosen, now(self));
      },
      [self](const service_end& end) { self->state.on_end(end); },
      [self](tick_atom, std::uint64_t number) {
        self->state.selector->on_timer(number, now(self));
      },
  };
}

} // namespace

requester_manager_actor spawn_requester_manager(caf::actor_system& sys,
                                                requester_manager_setup setup) {
  return sys.spawn(requester_manager, std::move(setup));
}

} // namespace sofof
