// The QoS watchdog: its timer; the rules are in offloading/watchdog.
#include "actors/offloading/qos_watchdog.hpp"

#include "actors/runtime/time.hpp"
#include "offloading/watchdog.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <optional>
#include <string>
#include <utility>

namespace sofof::actors {

namespace {

using watchdog_impl = messages::watchdog_actor::extend<
    messages::reacts_to<messages::tick_atom, std::uint64_t>>;

struct watchdog_state {
  static inline const char* name = "qos_watchdog";

  watchdog_impl::stateful_pointer<watchdog_state> self;
  std::optional<offloading::watchdog> rules;
  messages::onboard_requester_actor requester;
  std::uint64_t epoch = 0; // of the one timer that counts

  void arm(const messages::session_id& session, time_point first) {
    rules->arm(session, first);
    ++epoch;
    set_timer();
  }

  void disarm(const messages::session_id& session) {
    if (rules->disarm(session))
      ++epoch;
  }

  // One timer is under way while armed; if results came meanwhile, it is
  // simply set again.
  void on_timer(std::uint64_t set_in) {
    if (set_in != epoch)
      return;
    if (auto violation = rules->on_deadline(now(self)))
      report(std::move(*violation));
    else
      set_timer();
  }

  void set_timer() {
    send_at(self, self, rules->deadline().value(), messages::tick_atom_v,
            epoch);
  }

  void report(messages::qos_violation violation) {
    self->send(requester, std::move(violation));
    ++epoch;
  }
};

watchdog_impl::behavior_type
watchdog(watchdog_impl::stateful_pointer<watchdog_state> self,
         messages::qos_limits limits,
         messages::onboard_requester_actor requester) {
  self->state.self = self;
  self->state.rules.emplace(limits);
  self->state.requester = std::move(requester);
  return {
      [self](const messages::session_id& session, time_point first) {
        self->state.arm(session, first);
      },
      [self](const messages::arrival& result) {
        if (auto late = self->state.rules->on_arrival(result, now(self)))
          self->state.report(std::move(*late));
      },
      [self](const messages::session_id& session, std::string& why,
             std::string& check) {
        self->state.rules->on_useless(session,
                                      {std::move(why), std::move(check)});
      },
      [self](const messages::qos_limits& limits) {
        self->state.rules->limit(limits);
      },
      [self](const messages::service_end& end) {
        self->state.disarm(end.session);
      },
      [self](messages::tick_atom, std::uint64_t epoch) {
        self->state.on_timer(epoch);
      },
  };
}

} // namespace

messages::watchdog_actor
spawn_qos_watchdog(caf::actor_system& sys, messages::qos_limits limits,
                   messages::onboard_requester_actor requester) {
  return sys.spawn(watchdog, limits, std::move(requester));
}

} // namespace sofof::actors
