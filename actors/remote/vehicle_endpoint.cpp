// One connection to a provider, from its introduction on.
#include "actors/remote/vehicle_endpoint.hpp"

#include "actors/remote/type_block.hpp"
#include "base/protocol.hpp"
#include "base/text/printable.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <utility>

namespace sofof {

namespace {

struct connection_state {
  static inline const char* name = "provider_connection";
  static constexpr auto closed = "it has closed the connection meanwhile";

  uplink_actor::stateful_pointer<connection_state> self = nullptr;
  gate_actor gate;
  std::shared_ptr<const uplink_setup> setup;
  connection_user user;
  std::uint64_t types = fingerprint_of_types();
  session_actor session; // once we are let in

  // The user lives long, and does not forget by itself who watched it.
  ~connection_state() {
    if (self)
      self->demonitor(user);
  }

  // -- introduction ---------------------------------------------------------

  void begin() {
    self->monitor(user);
    // A question that was forwarded gets no answer when the connection is gone.
    self->monitor(gate);
    self->request(gate, protocol::introduction_timeout, setup->protocol, types)
        .then(
            [this](std::uint32_t protocol, std::uint64_t theirs,
                   const std::string& nonce, const caf::strong_actor_ptr& in) {
              if (protocol != setup->protocol || theirs != types)
                refused(fmt::format("it speaks {}, this program {}; install "
                                    "the same version on both sides",
                                    spoken(protocol, theirs),
                                    spoken(setup->protocol, types)));
              else if (!in)
                not_now("it lets nobody in now");
              else
                introduce_at(caf::actor_cast<entrance_actor>(in), nonce);
            },
            [this](const caf::error& error) { not_now(sentence(error)); });
  }

  void introduce_at(const entrance_actor& entrance, const std::string& nonce) {
    peer_hello hello{setup->provider,
                     setup->stations,
                     setup->world,
                     setup->clock.epoch_unix_ms(),
                     {},
                     {}};
    setup->prove(hello, nonce);
    self->request(entrance, protocol::introduction_timeout, std::move(hello),
                  uplink_actor{self})
        .then(
            [this, at = entrance.node()](const peer_welcome& welcome,
                                         const session_actor& with) {
              if (!with || with.node() != at)
                not_now("it has no end of its own");
              else if (!is_time_of_day(welcome.epoch_unix_ms))
                refused("its clock shows no time of day");
              else
                let_in(welcome, with);
            },
            [this](const caf::error& error) {
              if (error == caf::sec::invalid_argument)
                refused(sentence(error));
              else
                not_now(sentence(error));
            });
  }

  void let_in(const peer_welcome& welcome, const session_actor& with) {
    self->demonitor(gate);
    session = with;
    self->send(user, welcome, with);
  }

  void refused(const std::string& why) { give_up(why, true); }
  void not_now(const std::string& why) { give_up(why, false); }
  void give_up(const std::string& why, bool for_ever) {
    self->send(user, why, for_ever);
    self->quit();
  }

  static std::string sentence(const caf::error& error) {
    if (error.context().match_elements<std::string>())
      return printable(error.context().get_as<std::string>(0));
    if (error == caf::sec::request_timeout)
      return "it does not answer";
    return closed;
  }

  void lost(const caf::actor_addr& who) {
    if (who == user.address())
      self->quit();
    else if (!session && who == gate.address())
      not_now(closed);
  }

  // -- what the provider says -----------------------------------------------

  template <class... Ts>
  void pass_on(const Ts&... xs) {
    if (session
        && self->current_sender()
               == caf::actor_cast<caf::strong_actor_ptr>(session))
      self->send(user, xs...);
  }
};

uplink_actor::behavior_type
connection(uplink_actor::stateful_pointer<connection_state> self,
           const gate_actor& gate, std::shared_ptr<const uplink_setup> setup,
           const connection_user& user) {
  auto& s = self->state;
  s.self = self;
  s.gate = gate;
  s.setup = std::move(setup);
  s.user = user;
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.lost(down.source); });
  self->set_default_handler(caf::drop); // what no interface has
  s.begin();
  return {
      [self](station_id station, const service_offer& offer) {
        self->state.pass_on(station, offer);
      },
      [self](const service_response& response) {
        self->state.pass_on(response);
      },
      [self](const service_result& result) { self->state.pass_on(result); },
      [self](const service_end& end) {
        if (end.from == side::provider)
          self->state.pass_on(end);
      },
      [self](const ping& sign) { self->state.pass_on(sign); },
      [self](const pong& echo) { self->state.pass_on(echo); },
      [self](const stream_id& stream) { self->state.pass_on(stream); },
  };
}

} // namespace

uplink_actor spawn_connection(caf::actor_system& sys, const gate_actor& gate,
                              std::shared_ptr<const uplink_setup> setup,
                              const connection_user& user) {
  return sys.spawn(connection, gate, std::move(setup), user);
}

} // namespace sofof
