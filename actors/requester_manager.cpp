// Service management in the vehicle: chooses the source of one service.
#include "actors/cpu_accounts.hpp"
#include "actors/on_air.hpp"
#include "actors/qos_watchdog.hpp"
#include "actors/service_manager.hpp"
#include "actors/time.hpp"
#include "policies/qos_monitor.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <optional>
#include <string>

namespace sofof {

namespace {

// A service at a provider, waited for or in use.
struct remote_source {
  running_service running;
  provider_manager_actor manager;
  bool in_use = false;
  bool in_doubt = false; // latencies cannot be judged
  std::optional<std::uint64_t> last_cycle;
  std::optional<time_point> last_sent;
  std::optional<time_point> last_received;
};

std::string in_ms(duration d) {
  return fmt::format("{:.1f} ms", 1e3 * to_seconds(d));
}

struct manager_state {
  static inline const char* name = "requester_manager";

  requester_manager_actor::stateful_pointer<manager_state> self;
  requester_manager_setup setup;
  instance_actor local;
  watchdog_actor watchdog;
  std::optional<remote_source> remote;
  service_input newest;
  payload in_use; // the last result that the client got

  void start() {
    setup.local.running = {0, setup.station, setup.kind, 0};
    setup.local.results = self;
    local = spawn_instance(self->system(), setup.local);
    self->link_to(local);
    watchdog = spawn_qos_watchdog(self->system(), setup.options.limits,
                                  setup.requester);
    self->link_to(watchdog);
    charge_all();
    self->send(local, lifecycle_step::configure);
    self->send(local, lifecycle_step::activate);
    self->send(setup.client, requester_manager_actor{self});
  }

  // For whom they work, in case somebody keeps accounts.
  void charge_all() {
    const cpu_account to{setup.station, setup.kind, remote && remote->in_use};
    for (const auto who : {self->id(), local.id(), watchdog.id()})
      charge(self->system(), who, to);
  }

  void feed(service_input& input) {
    newest = std::move(input);
    self->send(local, newest);
    if (remote && input_due())
      feed_remote();
  }

  bool input_due() const {
    return !remote->last_sent
           || now(self) - *remote->last_sent >= setup.options.input_period;
  }

  void feed_remote() {
    if (newest.what.type().empty())
      return;
    remote->last_sent = now(self);
    auto input = setup.on_air({remote->running, newest.at, newest.what, in_use},
                              !remote->in_use);
    if (input.what.type().empty())
      return; // nothing to say
    note_on_air(self, setup.recorder, input.what);
    self->send(remote->manager, std::move(input));
  }

  void await(const running_service& running,
             const provider_manager_actor& manager) {
    be_local();
    remote = remote_source{running, manager, false, false, {}, {}, {}};
    feed_remote();
  }

  void take(const service_result& result) {
    if (result.running.counter == 0) {
      if (!remote || !remote->in_use)
        use(result);
    } else if (remote && remote->running == result.running
               && result.cycle > remote->last_cycle) {
      auto meant = setup.off_air(
          result.what, {remote->running, newest.at, newest.what, in_use},
          now(self));
      if (!meant.type().empty())
        take_remote({result.running, result.cycle, result.created,
                     std::move(meant), result.about, result.doubt});
    }
  }

  void take_remote(const service_result& result) {
    const auto t = now(self);
    const auto usable =
        can_judge(result)
        && in_time(result.created, t, setup.options.limits.max_latency);
    std::optional<duration> gap; // only while in use
    if (remote->last_received)
      gap = t - *remote->last_received;
    self->send(setup.recorder,
               cycle_record{result.running, result.cycle, result.created, t,
                            gap, usable, result.doubt});
    remote->last_cycle = result.cycle;
    if (remote->in_use || usable)
      remote->last_received = t;
    if (!remote->in_use && usable)
      be_remote(t);
    else if (remote->in_use)
      self->send(watchdog, arrival{result.running, result.created, t});
    if (usable)
      use(result);
  }

  // Whose clock is not known well enough is not trusted with a latency.
  bool can_judge(const service_result& result) {
    const auto can = result.doubt <= setup.options.limits.max_latency / 2;
    if (can == remote->in_doubt) {
      remote->in_doubt = !can;
      self->send(setup.recorder,
                 event_record{now(self), can ? "clock_known" : "clock_in_doubt",
                              setup.station, result.running.provider,
                              setup.kind, result.running.counter,
                              in_ms(result.doubt)});
    }
    return can;
  }

  void use(const service_result& result) {
    in_use = result.what;
    self->send(setup.client, result);
  }

  void be_remote(time_point first) {
    remote->in_use = true;
    charge_all();
    self->send(local, lifecycle_step::deactivate);
    self->send(watchdog, remote->running, first);
    self->send(setup.client, source_change{setup.kind, true});
    self->send(setup.requester, remote->running);
  }

  void be_local() {
    const auto was_remote = remote && remote->in_use;
    remote.reset();
    if (!was_remote)
      return;
    charge_all();
    self->send(local, service_input{{}, newest.at, newest.what, in_use});
    self->send(local, lifecycle_step::activate);
    self->send(setup.client, source_change{setup.kind, false});
  }

  void end(const service_end& e) {
    if (!remote || remote->running != e.running)
      return;
    self->send(watchdog, e);
    be_local();
  }
};

requester_manager_actor::behavior_type
manager(requester_manager_actor::stateful_pointer<manager_state> self,
        requester_manager_setup setup) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  self->state.start();
  return {
      [self](const service_result& result) { self->state.take(result); },
      [self](service_input& input) { self->state.feed(input); },
      [self](const running_service& running,
             const provider_manager_actor& manager) {
        self->state.await(running, manager);
      },
      [self](const service_end& e) { self->state.end(e); },
  };
}

} // namespace

requester_manager_actor spawn_requester_manager(caf::actor_system& sys,
                                                requester_manager_setup setup) {
  return sys.spawn(manager, std::move(setup));
}

} // namespace sofof
