// A provider's acceptor, handshake and endpoint in one actor, which sends
// envelopes.
#include "actors/broker/brokered_provider.hpp"

#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <caf/typed_response_promise.hpp>

namespace sofof::actors {

namespace {

struct proxy_state {
  static inline const char* name = "brokered_provider";
  using shared_ptr = std::shared_ptr<vehicle_side::shared>;

  brokered_provider_actor::stateful_pointer<proxy_state> self = nullptr;
  shared_ptr shared;
  std::int64_t link = 0;
  std::string provider;
  std::optional<station_id> station; // the provider's, once it has answered
  messages::vehicle_endpoint_actor endpoint;
  caf::typed_response_promise<std::uint32_t, std::uint64_t, std::string,
                              caf::strong_actor_ptr>
      invited;
  caf::typed_response_promise<messages::peer_welcome,
                              messages::provider_endpoint_actor>
      welcomed;

  ~proxy_state() {
    if (!shared)
      return;
    if (endpoint)
      send(wire::closing{});
    const std::lock_guard lock{shared->mutex};
    shared->proxies.erase(link);
  }

  void send(wire::content what) const {
    shared->setup.send({.user = shared->setup.user,
                        .from = shared->setup.station,
                        .to = station,
                        .link = link,
                        .what = std::move(what)});
  }

  auto on_connect_request(std::uint32_t protocol, std::uint64_t types) {
    if (const auto& who = self->current_sender())
      self->monitor(who);
    invited = self->make_response_promise<std::uint32_t, std::uint64_t,
                                          std::string, caf::strong_actor_ptr>();
    send(wire::connect_request{provider, protocol, types});
    return invited;
  }

  void on_challenge(std::uint32_t protocol, std::uint64_t types,
                    const std::string& nonce) {
    if (invited.pending())
      invited.deliver(protocol, types, nonce,
                      nonce.empty()
                          ? caf::strong_actor_ptr{}
                          : caf::actor_cast<caf::strong_actor_ptr>(self));
  }

  auto on_hello(const messages::peer_hello& hello,
                const messages::vehicle_endpoint_actor& from) {
    endpoint = from;
    {
      const std::lock_guard lock{shared->mutex};
      shared->proxies[link].endpoint = from;
    }
    welcomed = self->make_response_promise<messages::peer_welcome,
                                           messages::provider_endpoint_actor>();
    send(hello);
    return welcomed;
  }

  void on_welcome(const messages::peer_welcome& welcome, station_id from) {
    station = from;
    if (welcomed.pending())
      welcomed.deliver(welcome, messages::provider_endpoint_actor{self});
  }

  void on_refusal(const std::string& why, bool for_ever) {
    const auto error = caf::make_error(
        for_ever ? caf::sec::invalid_argument : caf::sec::runtime_error, why);
    if (welcomed.pending())
      welcomed.deliver(error);
    else if (invited.pending())
      invited.deliver(error);
  }

  void acknowledge(const messages::stream_id& stream) {
    self->send(endpoint, stream);
  }

  void on_its_message(station_id from, const messages::its_pdu& message) {
    shared->tell(from, message);
    acknowledge(messages::stream_of(from, message));
  }

  void on_input(const messages::service_input& input) {
    send(input);
    acknowledge(
        messages::stream_of(input.session, messages::stream_id::what::input));
  }
};

brokered_provider_actor::behavior_type
brokered_provider(brokered_provider_actor::stateful_pointer<proxy_state> self,
                  std::shared_ptr<vehicle_side::shared> shared,
                  std::int64_t link, std::string provider) {
  auto& s = self->state;
  s.self = self;
  s.shared = std::move(shared);
  s.link = link;
  s.provider = std::move(provider);
  {
    const std::lock_guard lock{s.shared->mutex};
    s.shared->proxies.emplace(
        link,
        connected_proxy{s.provider, caf::weak_actor_ptr{self->ctrl()}, {}});
  }
  self->set_down_handler([self](const caf::down_msg&) { self->quit(); });
  return {
      // Of the vehicles:
      [self](std::uint32_t protocol, std::uint64_t types) {
        return self->state.on_connect_request(protocol, types);
      },
      [self](const messages::peer_hello& hello,
             const messages::vehicle_endpoint_actor& from) {
        return self->state.on_hello(hello, from);
      },
      [self](station_id::rep from, const messages::its_pdu& message) {
        self->state.on_its_message(from, message);
      },
      [self](const messages::service_request& x) { self->state.send(x); },
      [self](const messages::service_input& x) { self->state.on_input(x); },
      [self](const messages::service_end& x) { self->state.send(x); },
      [self](const messages::ping& x) { self->state.send(x); },
      [self](const messages::pong& x) { self->state.send(x); },
      [](const messages::stream_id&) {}, // the provider's side does so itself
      // Of the provider:
      [self](std::uint32_t protocol, std::uint64_t types,
             const std::string& nonce) {
        self->state.on_challenge(protocol, types, nonce);
      },
      [self](const messages::peer_welcome& welcome, station_id::rep from) {
        self->state.on_welcome(welcome, from);
      },
      [self](const std::string& why, bool for_ever) {
        self->state.on_refusal(why, for_ever);
      },
  };
}

} // namespace

brokered_provider_actor
spawn_brokered_provider(std::shared_ptr<vehicle_side::shared> shared,
                        std::int64_t link, std::string provider) {
  auto& sys = shared->sys;
  return sys.spawn(brokered_provider, std::move(shared), link,
                   std::move(provider));
}

} // namespace sofof::actors
