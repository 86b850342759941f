// SP: mailbox, timers and monitors; the rules are in offloading/provider.
#include "actors/offloading/service_provider.hpp"

#include "actors/offloading/provider_links.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "messages/v2x/decode_broadcast.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <optional>
#include <utility>

namespace sofof {

namespace {

struct provider_state {
  static inline const char* name = "service_provider";

  provider_impl::stateful_pointer<provider_state> self;
  recorder_actor recorder;
  georeference_ptr where;
  std::optional<provider_services> services;
  std::optional<provider_links> links;
  std::optional<offloading::provider> rules;

  void start(provider_setup setup) {
    recorder = setup.recorder;
    where = setup.where;
    services.emplace(setup, clock_of(self));
    links.emplace(self, *services, recorder);
    rules.emplace(rules_of(std::move(setup), *services), *links);
  }

  void on_broadcast(const its_pdu& message, const requester_actor& requester) {
    const auto heard = understand(message, *where, now(self));
    if (const auto* c = std::get_if<cam>(&heard)) {
      tell_contexts(*c, message.sender, c->station);
      links->with(requester, *rules,
                  [&](auto from) { rules->on_cam(*c, from, now(self)); });
    } else if (const auto* seen = std::get_if<object_list>(&heard)) {
      tell_contexts(*seen, message.sender, seen->from);
      links->with(requester, *rules, [&](auto from) {
        rules->on_sign_of_life(seen->from, from, now(self));
      });
    }
  }

  void on_request(const service_request& request,
                  const requester_actor& requester) {
    links->with(requester, *rules, [&](auto from) {
      rules->on_request(request, from, now(self));
    });
  }

  // A station that is alone in its process stands for itself.
  template <class Message>
  void tell_contexts(const Message& message, sender_id told,
                     station_id station) {
    const auto sender = told == 0 ? station : told;
    tell_contexts(
        [&](provider_context& context) { context.hear(message, sender); });
  }

  template <class Function>
  void tell_contexts(Function tell) {
    for (auto& news : services->tell_contexts(tell))
      send_record(self, recorder, std::move(news));
  }
};

provider_impl::behavior_type
provider(provider_impl::stateful_pointer<provider_state> self,
         provider_setup setup) {
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
      [self](const its_pdu& message, const requester_actor& requester) {
        self->state.on_broadcast(message, requester);
      },
      [self](const service_request& request, const requester_actor& requester) {
        self->state.on_request(request, requester);
      },
      [self](const service_end& end) {
        self->state.rules->on_end(end, now(self));
      },
      [self](const roadside_detections& view) {
        self->state.tell_contexts(
            [&](provider_context& context) { context.see(view); });
      },
      [self](tick_atom, std::uint64_t number) {
        self->state.rules->on_timer(number, now(self));
      },
  };
}

} // namespace

roadside_provider_actor spawn_service_provider(caf::actor_system& sys,
                                               provider_setup setup) {
  return sys.spawn(provider, std::move(setup));
}

} // namespace sofof
