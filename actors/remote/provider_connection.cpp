// A connection to a provider on another host: whose messages it minds.
#include "actors/remote/provider_connection.hpp"

#include "actors/remote/provider_connection_state.hpp"

#include <utility>

namespace sofof::actors {

namespace {

using connection_pointer =
    provider_connection_impl::stateful_pointer<provider_connection_state>;

/// @returns what is done with a message of the provider.
template <class Message>
auto of_provider(connection_pointer self,
                 void (provider_connection_state::*handle)(const Message&)) {
  return [self, handle](const Message& message) {
    if (self->state.is_from_connection())
      (self->state.*handle)(message);
  };
}

provider_connection_impl::behavior_type
provider_connection(connection_pointer self, provider_connection_setup setup) {
  self->state.self = self;
  self->state.start(std::move(setup));
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.on_down(down.source); });
  return {
      // Of the provider:
      [self](station_id::rep station, const messages::service_offer& offer) {
        if (self->state.is_from_connection())
          self->state.on_offer(station, offer);
      },
      of_provider(self, &provider_connection_state::on_response),
      of_provider(self, &provider_connection_state::on_digest),
      of_provider(self, &provider_connection_state::on_result),
      [self](const messages::service_end& e) { // or of a vehicle
        if (e.from == messages::side::requester)
          self->state.on_requester_end(e);
        else if (self->state.is_from_connection())
          self->state.on_provider_end(e);
      },
      of_provider(self, &provider_connection_state::on_ping),
      of_provider(self, &provider_connection_state::on_pong),
      of_provider(self, &provider_connection_state::on_acknowledgement),
      // Of vehicles:
      [self](station_id::rep station, const messages::its_pdu& message) {
        self->state.on_its_message(station, message);
      },
      [self](const messages::service_request& x) { self->state.on_request(x); },
      [self](const messages::service_input& x) { self->state.on_input(x); },
      [self](station_id::rep station, const messages::link_actor& vehicle) {
        self->state.vehicles.insert_or_assign(station, vehicle);
      },
      // Of its own timers, connections and attempts at one:
      [self](messages::tick_atom) { self->state.on_tick(); },
      [self](messages::tick_atom, station_id::rep of) {
        self->state.on_turn(of);
      },
      [self](const messages::peer_welcome& welcome,
             const messages::provider_endpoint_actor& peer) {
        if (self->state.is_from_connection())
          self->state.on_welcome(welcome, peer);
      },
      [self](const std::string& why, bool for_ever) {
        if (self->state.is_from_connection())
          self->state.on_refusal(why, for_ever);
      },
      [self](messages::tick_atom, const messages::acceptor_actor& acceptor) {
        self->state.on_acceptor(acceptor);
      },
      [self](messages::tick_atom, const std::string& why) {
        self->state.on_attempt_failed(why);
      },
  };
}

} // namespace

provider_outbox spawn_provider_connection(caf::actor_system& sys,
                                          provider_connection_setup setup) {
  return sys.spawn(provider_connection, std::move(setup));
}

void introduce(const provider_outbox& outbox, station_id station,
               const messages::link_actor& provider_proxy) {
  caf::anon_send(caf::actor_cast<provider_connection_impl>(outbox),
                 station.value(), provider_proxy);
}

} // namespace sofof::actors
