// SR: mailbox, timers and monitors; the rules are in offloading/requester.
#include "actors/offloading/service_requester.hpp"

#include "actors/offloading/own_function.hpp"
#include "actors/offloading/requester_links.hpp"
#include "actors/offloading/service_manager.hpp"
#include "actors/runtime/spawn_decider.hpp"
#include "actors/runtime/time.hpp"

#include <caf/stateful_actor.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

struct requester_state {
  static inline const char* name = "service_requester";

  requester_impl::stateful_pointer<requester_state> self;
  messages::vehicle_actor vehicle;
  std::optional<requester_links> links;
  std::optional<offloading::requester> rules;

  void start(requester_actor_setup setup) {
    vehicle = setup.vehicle;
    self->monitor(vehicle);
    links.emplace(self, setup.station, setup.recorder);
    std::vector<offloading::onboard_service> services;
    for (const auto& what : setup.services)
      services.push_back(add(setup, what));
    rules.emplace(rules_of(std::move(setup), std::move(services)), *links,
                  now(self));
  }

  offloading::onboard_service add(const requester_actor_setup& setup,
                                  const client_service& what) {
    auto service = in_vehicle(what.service, context_of(setup, clock_of(self)));
    const auto client = what.spawn_client(self->system(), vehicle);
    const auto own = own_function(setup, service, clock_of(self), what.seat);
    const auto manager = spawn_requester_manager(
        self->system(), {setup.station, service, own, client, self,
                         setup.recorder, setup.record_margins, setup.trace,
                         setup.lodm->needs_scene(), setup.computer});
    if (client != vehicle) // as its own client
      self->link_to(client);
    self->link_to(manager);
    links->add(service.name, manager);
    return service;
  }

  void on_down(const caf::actor_addr& who) {
    if (vehicle.address() == who) {
      rules->shut_down(now(self));
      self->quit(caf::exit_reason::user_shutdown);
    } else if (const auto peer = links->providers().find(who)) {
      rules->on_lost(*peer, now(self));
      links->providers().forget(*peer);
    }
  }
};

requester_impl::behavior_type
requester(requester_impl::stateful_pointer<requester_state> self,
          requester_actor_setup setup) {
  self->state.self = self;
  self->state.start(std::move(setup));
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.on_down(down.source); });
  self->set_exit_handler([self](const caf::exit_msg& exit) {
    self->state.rules->shut_down(now(self));
    self->quit(exit.reason);
  });
  return {
      [self](const messages::service_result& result) {
        self->state.rules->on_result(result, now(self));
      },
      [self](const messages::service_offer& offer) {
        if (const auto from = self->state.links->sender())
          self->state.rules->on_offer(offer, *from, now(self));
      },
      [self](messages::service_response& response,
             const std::vector<messages::provider_manager_actor>& managers) {
        self->state.links->take_up(response, managers);
        self->state.rules->on_response(response, now(self));
      },
      [self](const messages::session_digest& digest) {
        if (const auto from = self->state.links->sender())
          self->state.rules->on_digest(digest, *from, now(self));
      },
      [self](const messages::service_end& end) {
        self->state.rules->on_end(end, now(self));
      },
      [self](const messages::ego_state& x) { self->state.rules->on_motion(x); },
      [self](const messages::session_id& session) {
        self->state.rules->on_first_data(session, now(self));
      },
      [self](const messages::service_name& service, duration longest) {
        self->state.rules->on_safe_response(service, longest, now(self));
      },
      [self](const messages::qos_violation& violation) {
        self->state.rules->on_violation(violation, now(self));
      },
      [self](messages::tick_atom, std::uint64_t number) {
        self->state.rules->on_timer(number, now(self));
      },
  };
}

} // namespace

messages::onboard_requester_actor
spawn_service_requester(caf::actor_system& sys, requester_actor_setup setup) {
  return spawn_decider(sys, *setup.lodm, requester, std::move(setup));
}

} // namespace sofof::actors
