// Service management in the vehicle: mailbox and timers; the rules are in
// offloading/source_selector.
#include "actors/offloading/selector_links.hpp"
#include "actors/runtime/time.hpp"
#include "offloading/source_selector.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <optional>
#include <utility>

namespace sofof::actors {

namespace {

struct requester_manager_state {
  static inline const char* name = "requester_manager";

  requester_manager_impl::stateful_pointer<requester_manager_state> self;
  std::optional<selector_links> links;
  std::optional<offloading::source_selector> selector;

  void start(requester_manager_setup setup) {
    links.emplace(self, setup);
    selector.emplace(offloading::selector_setup{setup.station, setup.service,
                                                setup.record_margins,
                                                setup.trace, setup.asks_scene,
                                                setup.computer},
                     *links);
    links->start(std::move(setup));
  }

  void on_session(const messages::session_id& session,
                  messages::provider_manager_actor manager) {
    links->add(session, std::move(manager));
    selector->on_session(session, now(self));
  }

  void on_end(const messages::service_end& end) {
    selector->on_end(end, now(self));
    links->forget(end.session);
  }
};

requester_manager_impl::behavior_type requester_manager(
    requester_manager_impl::stateful_pointer<requester_manager_state> self,
    requester_manager_setup setup) {
  self->state.self = self;
  self->state.start(std::move(setup));
  self->set_exit_handler([self](const caf::exit_msg& exit) {
    self->state.selector->record_work();
    self->quit(exit.reason);
  });
  return {
      [self](const messages::service_result& result) {
        self->state.links->count(result);
        self->state.selector->on_result(result, now(self));
      },
      [self](const messages::service_input& input) {
        self->state.selector->on_input(input, now(self));
      },
      [self](const messages::session_id& session,
             messages::provider_manager_actor& manager) {
        self->state.on_session(session, std::move(manager));
      },
      [self](const messages::standby& chosen) {
        self->state.selector->on_standby(chosen, now(self));
      },
      [self](messages::no_standby_atom) {
        self->state.selector->on_standby(std::nullopt, now(self));
      },
      [self](messages::home_is_near_atom) {
        self->state.selector->on_home_is_near(now(self));
      },
      [self](const messages::service_end& end) { self->state.on_end(end); },
      [self](messages::tick_atom, std::uint64_t number) {
        self->state.selector->on_timer(number, now(self));
      },
  };
}

} // namespace

messages::requester_manager_actor
spawn_requester_manager(caf::actor_system& sys, requester_manager_setup setup) {
  return sys.spawn(requester_manager, std::move(setup));
}

} // namespace sofof::actors
