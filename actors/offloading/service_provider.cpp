// SP: mailbox, timers and monitors; the rules are in offloading/provider.
#include "actors/offloading/service_provider.hpp"

#include "actors/offloading/broadcast_listener.hpp"
#include "actors/offloading/provider_links.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/runtime/spawn_decider.hpp"
#include "actors/runtime/time.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <functional>
#include <optional>
#include <utility>

namespace sofof::actors {

namespace {

struct provider_state {
  static inline const char* name = "service_provider";

  provider_impl::stateful_pointer<provider_state> self;
  messages::recorder_actor recorder;
  std::function<messages::broadcast(const messages::its_pdu&, time_point)>
      decode;
  std::optional<provider_services> services;
  std::optional<provider_links> links;
  std::optional<offloading::provider> rules;

  void start(provider_actor_setup setup) {
    recorder = setup.recorder;
    decode = setup.decode;
    services.emplace(setup, clock_of(self));
    links.emplace(self, *services, recorder);
    rules.emplace(rules_of(std::move(setup), *services), *links);
  }

  void on_broadcast(const messages::its_pdu& message,
                    const messages::requester_actor& requester) {
    const auto station = message.station().value_or(0);
    if (!requester && rules->serves(station))
      return; // somebody else speaks in its name
    // A station that is alone in its process stands for itself.
    const auto sender = message.sender.value_or(sender_id{station.value()});
    const auto heard = decode(message, now(self));
    if (const auto* c = std::get_if<messages::cam>(&heard)) {
      tell([&](broadcast_listener& x) { x.on_cam(*c, sender); });
      links->with(requester, *rules,
                  [&](auto from) { rules->on_cam(*c, from, now(self)); });
    } else if (const auto* seen = std::get_if<messages::object_list>(&heard)) {
      tell([&](broadcast_listener& x) { x.on_objects(*seen, sender); });
    } else if (const auto* word = std::get_if<messages::decoded_mcm>(&heard)) {
      tell([&](broadcast_listener& x) { x.on_word(*word, sender); });
    }
  }

  void on_request(const messages::service_request& request,
                  const messages::requester_actor& requester) {
    links->with(requester, *rules, [&](auto from) {
      rules->on_request(request, from, now(self));
    });
  }

  template <class Function>
  void tell(Function what) {
    for (auto& doubt : services->tell_listeners(what))
      send_record(self, recorder, std::move(doubt));
  }
};

provider_impl::behavior_type
provider(provider_impl::stateful_pointer<provider_state> self,
         provider_actor_setup setup) {
  self->state.self = self;
  self->state.start(std::move(setup));
  self->set_down_handler([self](const caf::down_msg& down) {
    self->state.links->on_down(down, *self->state.rules);
  });
  self->set_exit_handler([self](const caf::exit_msg& exit) {
    self->state.rules->shut_down(now(self));
    self->quit(exit.reason);
  });
  return {
      [self](const messages::its_pdu& message,
             const messages::requester_actor& requester) {
        self->state.on_broadcast(message, requester);
      },
      [self](const messages::service_request& request,
             const messages::requester_actor& requester) {
        self->state.on_request(request, requester);
      },
      [self](const messages::service_end& end) {
        self->state.rules->on_end(end, now(self));
      },
      [self](const messages::roadside_detections& view) {
        self->state.tell([&](broadcast_listener& x) { x.on_detections(view); });
      },
      [self](const messages::ego_state& carrier) {
        self->state.services->ride(carrier.own.position);
        self->state.rules->on_ride(carrier.own, now(self));
      },
      [self](messages::tick_atom, std::uint64_t number) {
        self->state.rules->on_timer(number, now(self));
      },
  };
}

} // namespace

messages::roadside_provider_actor
spawn_service_provider(caf::actor_system& sys, provider_actor_setup setup) {
  return spawn_decider(sys, *setup.codm, provider, std::move(setup));
}

} // namespace sofof::actors
