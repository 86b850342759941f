// The QoS watchdog: barks when results come late or stop coming.
#include "actors/offloading/qos_watchdog.hpp"

#include "actors/runtime/time.hpp"
#include "offloading/qos_monitor.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <optional>
#include <string>
#include <utility>

namespace sofof {

namespace {

using watchdog_impl =
    watchdog_actor::extend<reacts_to<tick_atom, std::uint64_t>>;

struct watchdog_state {
  static inline const char* name = "qos_watchdog";

  watchdog_impl::stateful_pointer<watchdog_state> self;
  qos_limits limits;
  onboard_requester_actor requester;
  std::optional<session_id> watched;
  gap_monitor gaps{duration{0}};
  std::string useless;     // why the results since the last arrival are so
  std::uint64_t epoch = 0; // of the one timer that counts

  void arm(const session_id& running, time_point first) {
    watched = running;
    gaps = gap_monitor{limits.max_interarrival};
    gaps.arrived(first);
    useless.clear();
    ++epoch;
    set_timer();
  }

  void take(const arrival& a) {
    if (watched != a.running)
      return;
    gaps.arrived(a.received);
    useless.clear();
    if (!in_time(a.created, a.received, limits.max_latency))
      bark(qos_breach::latency);
  }

  void take_useless(const session_id& running, std::string why) {
    if (watched == running)
      useless = std::move(why);
  }

  void disarm(const session_id& running) {
    if (watched != running)
      return;
    watched.reset();
    ++epoch;
  }

  // One timer is under way while armed; if results came meanwhile, it is
  // simply set again.
  void tick(std::uint64_t set_in) {
    if (set_in != epoch)
      return;
    if (gaps.too_long(now(self)))
      bark(qos_breach::gap);
    else
      set_timer();
  }

  void set_timer() { send_at(self, self, gaps.deadline(), tick_atom_v, epoch); }

  void bark(qos_breach breach) {
    qos_violation found{*watched, breach, now(self)};
    if (breach == qos_breach::gap && !useless.empty()) {
      found.breach = qos_breach::implausible;
      found.why = std::move(useless);
    }
    self->send(requester, std::move(found));
    watched.reset();
    ++epoch;
  }
};

watchdog_impl::behavior_type
watchdog(watchdog_impl::stateful_pointer<watchdog_state> self,
         qos_limits limits, onboard_requester_actor requester) {
  self->state.self = self;
  self->state.limits = limits;
  self->state.requester = std::move(requester);
  return {
      [self](const session_id& running, time_point first) {
        self->state.arm(running, first);
      },
      [self](const arrival& a) { self->state.take(a); },
      [self](const session_id& running, std::string& why) {
        self->state.take_useless(running, std::move(why));
      },
      [self](const service_end& end) { self->state.disarm(end.running); },
      [self](tick_atom, std::uint64_t epoch) { self->state.tick(epoch); },
  };
}

} // namespace

watchdog_actor spawn_qos_watchdog(caf::actor_system& sys, qos_limits limits,
                                  onboard_requester_actor requester) {
  return sys.spawn(watchdog, limits, std::move(requester));
}

} // namespace sofof
