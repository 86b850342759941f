// A provider on another host, as one vehicle sees it.
#include "actors/remote/provider_proxy.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <vector>

namespace sofof::actors {

namespace {

struct provider_proxy_state {
  static inline const char* name = "provider_proxy";

  messages::link_actor::pointer self = nullptr;
  station_id station = 0;
  provider_outbox outbox;
  messages::requester_actor near; // once it has sent something

  template <class Message>
  void down(const Message& message) {
    if (near)
      self->send(near, message);
  }

  // Inputs for its managers come here: there are as many of it.
  void on_response(const messages::service_response& response) {
    if (!near)
      return;
    const auto accepted =
        std::ranges::count_if(response.verdicts, &messages::verdict::accepted);
    self->send(
        near, response,
        std::vector<messages::provider_manager_actor>(
            static_cast<std::size_t>(accepted),
            messages::provider_manager_actor{messages::link_actor{self}}));
  }

  void on_end(const messages::service_end& end) {
    if (end.from == messages::side::provider)
      down(end);
    else
      self->send(outbox, end);
  }
};

messages::link_actor::behavior_type provider_proxy(
    messages::link_actor::stateful_pointer<provider_proxy_state> self,
    station_id station, provider_outbox outbox) {
  self->state.self = self;
  self->state.station = station;
  self->state.outbox = std::move(outbox);
  return {
      [self](const messages::its_pdu& message,
             const messages::requester_actor& requester) {
        self->state.near = requester;
        self->send(self->state.outbox, self->state.station.value(), message);
      },
      [self](const messages::service_request& request,
             const messages::requester_actor& requester) {
        self->state.near = requester;
        self->send(self->state.outbox, request);
      },
      [self](const messages::service_end& end) { self->state.on_end(end); },
      [self](const messages::service_result& result) {
        self->state.down(result);
      },
      [self](const messages::service_offer& offer) { self->state.down(offer); },
      [self](const messages::session_digest& digest) {
        self->state.down(digest);
      },
      [self](const messages::service_response& response,
             const std::vector<messages::provider_manager_actor>&) {
        self->state.on_response(response);
      },
      [self](const messages::service_input& input) {
        self->send(self->state.outbox, input);
      },
  };
}

} // namespace

messages::link_actor spawn_provider_proxy(caf::actor_system& sys,
                                          station_id station,
                                          const provider_outbox& outbox) {
  return sys.spawn(provider_proxy, station, outbox);
}

} // namespace sofof::actors
