// It introduces itself as a peer on another host does, and sends envelopes.
#include "actors/broker/vehicle_process.hpp"

#include "base/protocol.hpp"

#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

namespace sofof::actors {

namespace {

struct process_state {
  static inline const char* name = "process_of_vehicles";

  process_actor::stateful_pointer<process_state> self = nullptr;
  std::shared_ptr<provider_side::shared> shared;
  std::int64_t link = 0;
  station_id sender = 0;
  messages::handshake_actor handshake;
  messages::provider_endpoint_actor endpoint;

  ~process_state() {
    if (!shared)
      return;
    if (endpoint)
      send(sender, wire::closing{});
    shared->forget(link);
  }

  void send(station_id to, wire::content what) const {
    shared->setup.send({.user = shared->setup.user,
                        .from = shared->setup.station,
                        .to = to,
                        .link = link,
                        .what = std::move(what)});
  }

  void refuse(const caf::error& error) {
    send(sender, wire::refusal{sentence_of(error),
                               error == caf::sec::invalid_argument});
    self->quit();
  }

  static std::string sentence_of(const caf::error& error) {
    if (const auto& words = error.context();
        words.match_elements<std::string>())
      return words.get_as<std::string>(0);
    return to_string(error);
  }

  void connect_request(std::uint32_t protocol, std::uint64_t types) {
    self->request(shared->setup.acceptor, protocol::handshake_timeout, protocol,
                  types)
        .then(
            [this](std::uint32_t ours, std::uint64_t our_types,
                   const std::string& nonce, const caf::strong_actor_ptr& in) {
              send(sender, wire::challenge{ours, our_types, nonce});
              handshake = caf::actor_cast<messages::handshake_actor>(in);
              if (handshake)
                self->monitor(handshake);
              else
                self->quit();
            },
            [this](const caf::error& error) { refuse(error); });
  }

  void on_hello(const messages::peer_hello& hello) {
    if (!handshake || endpoint)
      return;
    self->demonitor(handshake);
    self->request(handshake, protocol::handshake_timeout, hello,
                  messages::vehicle_endpoint_actor{self})
        .then(
            [this, hello](const messages::peer_welcome& welcome,
                          const messages::provider_endpoint_actor& by) {
              endpoint = by;
              self->monitor(endpoint);
              shared->let_in(link, hello, endpoint);
              send(sender, welcome);
            },
            [this](const caf::error& error) { refuse(error); });
  }

  void on_result(const messages::service_result& x) {
    send(x.session.station, x);
    self->send(endpoint, messages::stream_of(
                             x.session, messages::stream_id::what::result));
  }
};

process_actor::behavior_type
process_of_vehicles(process_actor::stateful_pointer<process_state> self,
                    std::shared_ptr<provider_side::shared> shared,
                    std::int64_t link, station_id sender,
                    const wire::connect_request& connect_request) {
  auto& s = self->state;
  s.self = self;
  s.shared = std::move(shared);
  s.link = link;
  s.sender = sender;
  self->set_down_handler([self](const caf::down_msg&) { self->quit(); });
  s.connect_request(connect_request.protocol, connect_request.types);
  return {
      [self](station_id::rep to, const messages::service_offer& x) {
        self->state.send(to, wire::offer{x});
      },
      [self](const messages::service_response& x) {
        self->state.send(x.station, x);
      },
      [self](const messages::session_digest& x) {
        self->state.send(x.station, x);
      },
      [self](const messages::service_result& x) { self->state.on_result(x); },
      [self](const messages::service_end& x) {
        self->state.send(x.session.station, x);
      },
      [self](const messages::ping& x) {
        self->state.send(self->state.sender, x);
      },
      [self](const messages::pong& x) {
        self->state.send(self->state.sender, x);
      },
      [](const messages::stream_id&) {}, // the vehicles' side does so itself
      [self](const messages::peer_hello& x) { self->state.on_hello(x); },
  };
}

} // namespace

process_actor spawn_process(std::shared_ptr<provider_side::shared> shared,
                            std::int64_t link, station_id sender,
                            const wire::connect_request& connect_request) {
  auto& sys = shared->sys;
  return sys.spawn(process_of_vehicles, std::move(shared), link, sender,
                   connect_request);
}

} // namespace sofof::actors
