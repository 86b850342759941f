// How a process of vehicles introduces itself to a provider, and what that
// sends afterwards.
#include "actors/remote/vehicle_endpoint.hpp"

#include "actors/remote/type_block.hpp"
#include "base/protocol.hpp"
#include "base/text/printable.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <utility>

namespace sofof::actors {

namespace {

struct vehicle_endpoint_state {
  static inline const char* name = "vehicle_endpoint";
  static constexpr auto closed = "it has closed the connection meanwhile";

  messages::vehicle_endpoint_actor::stateful_pointer<vehicle_endpoint_state>
      self = nullptr;
  messages::acceptor_actor acceptor;
  std::shared_ptr<const provider_connection_setup> setup;
  vehicle_endpoint_owner owner;
  std::uint64_t types = fingerprint_of_types();
  messages::provider_endpoint_actor peer; // once we are let in

  // The owner lives long, and does not forget by itself who watched it.
  ~vehicle_endpoint_state() {
    if (self)
      self->demonitor(owner);
  }

  // -- introduction ---------------------------------------------------------

  void begin() {
    self->monitor(owner);
    // A question that was forwarded gets no answer when the connection is gone.
    self->monitor(acceptor);
    self->request(acceptor, protocol::handshake_timeout, setup->protocol, types)
        .then(
            [this](std::uint32_t protocol, std::uint64_t theirs,
                   const std::string& nonce, const caf::strong_actor_ptr& in) {
              on_version(protocol, theirs, nonce, in);
            },
            [this](const caf::error& error) { not_now(sentence(error)); });
  }

  void on_version(std::uint32_t protocol, std::uint64_t theirs,
                  const std::string& nonce, const caf::strong_actor_ptr& in) {
    if (protocol != setup->protocol || theirs != types)
      refused(fmt::format("it speaks {}, this program {}; install the same "
                          "version on both sides",
                          spoken(protocol, theirs),
                          spoken(setup->protocol, types)));
    else if (!in)
      not_now("it lets nobody in now");
    else
      introduce_at(caf::actor_cast<messages::handshake_actor>(in), nonce);
  }

  void introduce_at(const messages::handshake_actor& handshake,
                    const std::string& nonce) {
    messages::peer_hello hello{setup->provider,
                               setup->stations,
                               setup->world,
                               setup->clock.epoch_unix_ms(),
                               {},
                               {}};
    setup->prove(hello, nonce);
    self->request(handshake, protocol::handshake_timeout, std::move(hello),
                  messages::vehicle_endpoint_actor{self})
        .then(
            [this, at = handshake.node()](
                const messages::peer_welcome& welcome,
                const messages::provider_endpoint_actor& with) {
              on_welcome(welcome, with, at);
            },
            [this](const caf::error& error) {
              if (error == caf::sec::invalid_argument)
                refused(sentence(error));
              else
                not_now(sentence(error));
            });
  }

  /// @param process  That of the handshake.
  void on_welcome(const messages::peer_welcome& welcome,
                  const messages::provider_endpoint_actor& with,
                  const caf::node_id& process) {
    if (!with || with.node() != process) {
      not_now("it has no end of its own");
      return;
    }
    if (!messages::is_time_of_day(welcome.epoch_unix_ms)) {
      refused("its clock shows no time of day");
      return;
    }
    self->demonitor(acceptor);
    peer = with;
    self->send(owner, welcome, with);
  }

  void refused(const std::string& why) { give_up(why, true); }
  void not_now(const std::string& why) { give_up(why, false); }
  void give_up(const std::string& why, bool for_ever) {
    self->send(owner, why, for_ever);
    self->quit();
  }

  static std::string sentence(const caf::error& error) {
    if (error.context().match_elements<std::string>())
      return printable(error.context().get_as<std::string>(0));
    if (error == caf::sec::request_timeout)
      return "it does not answer";
    return closed;
  }

  void on_down(const caf::actor_addr& who) {
    if (who == owner.address())
      self->quit();
    else if (!peer && who == acceptor.address())
      not_now(closed);
  }

  // -- what the provider sends ----------------------------------------------

  template <class... Ts>
  void pass_on(const Ts&... xs) {
    if (peer
        && self->current_sender()
               == caf::actor_cast<caf::strong_actor_ptr>(peer))
      self->send(owner, xs...);
  }
};

messages::vehicle_endpoint_actor::behavior_type vehicle_endpoint(
    messages::vehicle_endpoint_actor::stateful_pointer<vehicle_endpoint_state>
        self,
    const messages::acceptor_actor& acceptor,
    std::shared_ptr<const provider_connection_setup> setup,
    const vehicle_endpoint_owner& owner) {
  auto& s = self->state;
  s.self = self;
  s.acceptor = acceptor;
  s.setup = std::move(setup);
  s.owner = owner;
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.on_down(down.source); });
  self->set_default_handler(caf::drop); // what no interface has
  s.begin();
  return {
      [self](station_id::rep station, const messages::service_offer& offer) {
        self->state.pass_on(station, offer);
      },
      [self](const messages::service_response& response) {
        self->state.pass_on(response);
      },
      [self](const messages::session_digest& digest) {
        self->state.pass_on(digest);
      },
      [self](const messages::service_result& result) {
        self->state.pass_on(result);
      },
      [self](const messages::service_end& end) {
        if (end.from == messages::side::provider)
          self->state.pass_on(end);
      },
      [self](const messages::ping& sign) { self->state.pass_on(sign); },
      [self](const messages::pong& echo) { self->state.pass_on(echo); },
      [self](const messages::stream_id& stream) {
        self->state.pass_on(stream);
      },
  };
}

} // namespace

messages::vehicle_endpoint_actor
spawn_vehicle_endpoint(caf::actor_system& sys,
                       const messages::acceptor_actor& acceptor,
                       std::shared_ptr<const provider_connection_setup> setup,
                       const vehicle_endpoint_owner& owner) {
  return sys.spawn(vehicle_endpoint, acceptor, std::move(setup), owner);
}

} // namespace sofof::actors
