// Service management in the vehicle: chooses the source of one service.
#include "actors/offloading/qos_watchdog.hpp"
#include "actors/offloading/service_manager.hpp"
#include "actors/runtime/cpu_accounts.hpp"
#include "actors/runtime/on_air.hpp"
#include "actors/runtime/time.hpp"
#include "base/protocol.hpp"
#include "offloading/first_response.hpp"
#include "offloading/qos_monitor.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sofof {

namespace {

// A service at a provider, waited for or in use.
struct remote_source {
  session_id running;
  provider_manager_actor manager;
  std::unique_ptr<result_judge> judge;
  bool in_use = false;
  bool in_doubt = false; // latencies cannot be judged
  bool given_up = false;
  std::optional<std::uint64_t> last_cycle;
  std::optional<time_point> last_sent;
  std::optional<time_point> last_received;
  std::optional<time_point> last_in_time;
  std::string useless; // why the results since then are so
  time_point useless_at;
  bool told_on_call = false; // by the last input
  int calls_in_vain = 0;
};

// Besides its interface: the timer with this number says that it is time to
// call.
using manager_impl =
    requester_manager_actor::extend<reacts_to<tick_atom, std::uint64_t>>;

std::string in_ms(duration d) {
  return fmt::format("{:.1f} ms", 1e3 * to_seconds(d));
}

std::string in_words(const objection& why) {
  return fmt::format("{} value={:.3f} limit={:.3f}", why.check, why.value,
                     why.limit);
}

struct offloaded_state {
  static inline const char* name = "requester_manager";

  manager_impl::stateful_pointer<offloaded_state> self;
  requester_manager_setup setup;
  instance_actor local;
  watchdog_actor watchdog;
  std::vector<remote_source> remotes;
  first_response answers;  // of planning cycles, by any of them
  provider_id hedge = 0;   // the provider that is on call beside others,
  duration hedge_after{};  // when a cycle is not answered for so long
  time_point began;        // the latest cycle of who is not on call
  std::uint64_t timer = 0; // the one that counts
  session_id watched;      // by whose name the watchdog watches
  service_input newest;
  payload in_use;     // the last result that the client got,
  session_id source;  // of whom,
  time_point used_at; // and when

  void start() {
    setup.local.running = {0, setup.station, setup.kind, 0};
    setup.local.results = self;
    answers = first_response{setup.options.period};
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
    const cpu_account to{setup.station, setup.kind, is_remote()};
    for (const auto who : {self->id(), local.id(), watchdog.id()})
      charge(self->system(), who, to);
  }

  std::ptrdiff_t sources() const {
    return std::ranges::count(remotes, true, &remote_source::in_use);
  }
  bool is_remote() const { return sources() > 0; }

  void feed(service_input& input) {
    newest = std::move(input);
    self->send(local, newest);
    for (auto& remote : remotes)
      if (input_due(remote) && !(remote.in_use && is_on_call(remote)))
        feed_remote(remote);
  }

  bool input_due(const remote_source& remote) const {
    return !remote.last_sent
           || now(self) - *remote.last_sent >= setup.options.input_period;
  }

  // @returns whether there was anything to say.
  bool feed_remote(remote_source& remote) {
    if (newest.what.type().empty())
      return false;
    remote.last_sent = now(self);
    const auto on_call = is_on_call(remote);
    auto input = setup.on_air({remote.running, newest.at, newest.what, in_use},
                              !remote.in_use || on_call || remote.told_on_call);
    if (input.what.type().empty())
      return false;
    if (remote.told_on_call && !on_call)
      remote.last_in_time = now(self); // patience begins
    input.on_call = remote.told_on_call = on_call;
    note_on_air(self, setup.recorder, input.what);
    self->send(remote.manager, std::move(input));
    return true;
  }

  void await(const session_id& running, const provider_manager_actor& manager) {
    auto& remote = remotes.emplace_back();
    remote.running = running;
    remote.manager = manager;
    remote.judge = setup.make_judge();
    feed_remote(remotes.back());
  }

  void take(const service_result& result) {
    if (result.running.counter == 0) {
      if (!is_remote())
        use(result);
      return;
    }
    const auto remote =
        std::ranges::find(remotes, result.running, &remote_source::running);
    if (remote == remotes.end() || !(result.cycle > remote->last_cycle))
      return;
    remote->last_cycle = result.cycle;
    const auto t = now(self); // judging takes time of its own
    const auto in_limits =
        can_judge(*remote, result)
        && in_time(result.created, t, setup.options.limits.max_latency);
    if (!in_limits) {
      take_remote(*remote, result, t, false, {});
      return;
    }
    auto judged = remote->judge->judge(
        result.what, {remote->running, newest.at, newest.what, in_use}, t);
    if (judged.refused || judged.useless)
      self->send(setup.recorder, cycle_record{result.running,
                                              result.cycle,
                                              result.created,
                                              t,
                                              {},
                                              false,
                                              result.doubt});
    if (judged.refused)
      refuse(result.running, *judged.refused);
    else if (judged.useless)
      leave_out(*remote, *judged.useless);
    else if (!judged.what.type().empty())
      take_remote(*remote,
                  {result.running, result.cycle, result.created,
                   std::move(judged.what), result.about, result.doubt},
                  t, true, judged.margins);
  }

  // Who sends what is implausible is left in the same turn.
  void refuse(const session_id& running, const objection& why) {
    end({running, end_reason::implausible, side::requester});
    self->send(setup.requester, qos_violation{running, qos_breach::implausible,
                                              now(self), true, in_words(why)});
  }

  void leave_out(remote_source& remote, const objection& why) {
    remote.useless = in_words(why);
    remote.useless_at = now(self);
    self->send(watchdog, remote.running, remote.useless);
  }

  // @param t          When it came.
  // @param in_limits  It came in time.
  void take_remote(remote_source& remote, const service_result& result,
                   time_point t, bool in_limits,
                   std::span<const margin> margins) {
    if (in_limits && !is_on_call(remote) && result.created > began)
      await_next(result.created);
    const auto alone = !is_remote() || (remote.in_use && sources() == 1);
    const auto fits = in_limits && (alone || continues(result));
    // Who is on call answers the cycle that it was called for.
    const auto start = is_on_call(remote) ? began : result.created;
    const auto first = fits && answers.use(start);
    const auto usable = fits && (alone || first);
    std::optional<duration> gap; // only while in use every period
    if (remote.last_received)
      gap = t - *remote.last_received;
    cycle_record record{result.running, result.cycle, result.created, t, gap,
                        usable,         result.doubt};
    if (usable && setup.record_margins)
      for (const auto& x : margins)
        record.margins.push_back({std::string{x.name}, x.left});
    self->send(setup.recorder, std::move(record));
    if (is_on_call(remote))
      remote.last_received.reset();
    else if (remote.in_use || in_limits)
      remote.last_received = t;
    if (in_limits) {
      remote.last_in_time = t;
      remote.useless.clear();
      remote.calls_in_vain = 0;
    }
    if (remote.in_use && alone && !remote.in_doubt)
      self->send(watchdog, arrival{watched, result.created, t});
    else if (is_remote() && usable)
      // The gap between results that are used is what counts; one that is late
      // harms nobody.
      self->send(watchdog, arrival{watched, t, t});
    if (!remote.in_use && in_limits)
      be_remote(remote);
    if (usable)
      use(result);
    if (sources() > 1)
      give_up_silent();
    if (is_on_call(remote) && input_due(remote))
      feed_remote(remote); // it has not heard that it is on call
  }

  // -- the hedge ------------------------------------------------------------

  // Alone nobody is.
  bool is_on_call(const remote_source& remote) const {
    return remote.running.provider == hedge && sources() > remote.in_use;
  }

  void be_on_call(provider_id provider, duration after) {
    hedge = provider;
    hedge_after = after;
    tell_duties();
    await_next(began);
  }

  // Whoever comes to be on call, or no longer is, is told by an input.
  void tell_duties() {
    for (auto& remote : remotes)
      if (remote.in_use && remote.told_on_call != is_on_call(remote))
        feed_remote(remote);
  }

  // The cycle after one that began at `start` shall be answered.
  void await_next(time_point start) {
    began = start;
    ++timer;
    if (hedge != 0)
      send_at(self, self, began + setup.options.period + hedge_after,
              tick_atom_v, timer);
  }

  // One more cycle has begun, or should have; more of them if this process has
  // stood still.
  void call(std::uint64_t set_as) {
    if (set_as != timer || !is_remote())
      return;
    const auto since = now(self) - hedge_after - began;
    await_next(began + since / setup.options.period * setup.options.period);
    if (!answers.hedge_due(began, now(self), hedge_after))
      return;
    for (auto& remote : remotes)
      if (remote.in_use && is_on_call(remote) && feed_remote(remote))
        ++remote.calls_in_vain;
  }

  // -- several at once ------------------------------------------------------

  // Two providers may disagree; the vehicle stays with the one that it follows
  // as long as that one goes on.
  bool continues(const service_result& result) const {
    constexpr auto patience = 2; // periods
    return result.running == source
           || now(self) - used_at > patience * setup.options.period
           || setup.continues(in_use, result.what, now(self));
  }

  // One of several that has not been in time for long is of no use.
  void give_up_silent() {
    const auto t = now(self);
    for (auto& remote : remotes) {
      const auto silent = is_on_call(remote)
                              ? remote.calls_in_vain * setup.options.period
                              : t - remote.last_in_time.value_or(t);
      if (remote.in_use && !remote.given_up
          && silent > protocol::start_timeout) {
        remote.given_up = true;
        const auto lies = !remote.useless.empty()
                          && t - remote.useless_at <= 2 * setup.options.period;
        const auto breach = lies ? qos_breach::implausible : qos_breach::gap;
        self->send(setup.requester, qos_violation{remote.running, breach, t,
                                                  true, remote.useless});
      }
    }
  }

  // Whose clock is not known well enough is not trusted with a latency: his
  // results are as good as none.
  bool can_judge(remote_source& remote, const service_result& result) {
    const auto can = result.doubt <= setup.options.limits.max_latency / 2;
    if (can == remote.in_doubt) {
      remote.in_doubt = !can;
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
    source = result.running;
    used_at = now(self);
    self->send(setup.client, result);
  }

  void be_remote(remote_source& remote) {
    const auto was_remote = is_remote();
    remote.in_use = true;
    if (!was_remote) {
      charge_all();
      self->send(local, lifecycle_step::deactivate);
      watch(remote.running, now(self));
      self->send(setup.client, source_change{setup.kind, true});
    }
    self->send(setup.requester, remote.running);
    tell_duties();
  }

  void watch(const session_id& running, time_point last) {
    watched = running;
    self->send(watchdog, running, last);
  }

  void be_local() {
    charge_all();
    self->send(local, service_input{{}, newest.at, newest.what, in_use});
    self->send(local, lifecycle_step::activate);
    self->send(setup.client, source_change{setup.kind, false});
  }

  void end(const service_end& e) {
    const auto remote =
        std::ranges::find(remotes, e.running, &remote_source::running);
    if (remote == remotes.end())
      return;
    const auto was_in_use = remote->in_use;
    remotes.erase(remote);
    if (!was_in_use)
      return;
    if (!is_remote()) {
      self->send(watchdog, e);
      if (e.reason == end_reason::implausible)
        in_use = {}; // nobody goes on with that
      be_local();
      return;
    }
    tell_duties();
    if (watched == e.running) {
      const auto next = std::ranges::find_if(remotes, [this](const auto& x) {
        return x.in_use && !is_on_call(x);
      });
      watch(next->running, used_at);
    }
  }
};

manager_impl::behavior_type
requester_manager(manager_impl::stateful_pointer<offloaded_state> self,
                  requester_manager_setup setup) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  self->state.start();
  return {
      [self](const service_result& result) { self->state.take(result); },
      [self](service_input& input) { self->state.feed(input); },
      [self](const session_id& running, const provider_manager_actor& manager) {
        self->state.await(running, manager);
      },
      [self](provider_id provider, duration after) {
        self->state.be_on_call(provider, after);
      },
      [self](const service_end& e) { self->state.end(e); },
      [self](tick_atom, std::uint64_t set_as) { self->state.call(set_as); },
  };
}

} // namespace

requester_manager_actor spawn_requester_manager(caf::actor_system& sys,
                                                requester_manager_setup setup) {
  return sys.spawn(requester_manager, std::move(setup));
}

} // namespace sofof
