// A connection to vehicles on another host: whose messages it minds.
#include "actors/remote/vehicle_connection.hpp"

#include "actors/remote/vehicle_connection_state.hpp"

#include <utility>

namespace sofof::actors {

namespace {

vehicle_connection_impl::behavior_type vehicle_connection(
    vehicle_connection_impl::stateful_pointer<vehicle_connection_state> self,
    vehicle_connection_setup setup,
    const messages::provider_endpoint_actor& endpoint) {
  self->state.self = self;
  self->state.start(std::move(setup), endpoint);
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.on_down(down); });
  self->set_exit_handler(
      [self](const caf::exit_msg&) { self->state.on_exit(); });
  return {
      // Of the peer:
      [self](station_id::rep station, const messages::its_pdu& message) {
        self->state.on_its_message(station, message);
      },
      [self](const messages::service_request& request) {
        self->state.on_request(request);
      },
      [self](const messages::service_input& input) {
        self->state.on_input(input);
      },
      [self](const messages::service_end& e) { // or of the provider
        if (e.from == messages::side::requester)
          self->state.on_requester_end(e);
        else
          self->state.on_provider_end(e);
      },
      [self](const messages::ping& sign) { self->state.on_ping(sign); },
      [self](const messages::pong& echo) { self->state.on_pong(echo); },
      [self](const messages::stream_id& stream) {
        self->state.on_acknowledgement(stream);
      },
      // Of the provider:
      [self](station_id::rep station, const messages::service_offer& offer) {
        self->state.on_offer(station, offer);
      },
      [self](const messages::session_digest& digest) {
        self->state.on_digest(digest);
      },
      [self](const messages::service_response& response,
             const std::vector<messages::provider_manager_actor>& managers) {
        self->state.on_response(response, managers);
      },
      [self](const messages::service_result& result) {
        self->state.on_result(result);
      },
      // Of its own timer, and of its endpoint:
      [self](messages::tick_atom) { self->state.on_tick(); },
      [self](const std::string& why) { self->state.on_dropped(why); },
  };
}

} // namespace

vehicle_connection_actor
spawn_vehicle_connection(caf::actor_system& sys, vehicle_connection_setup setup,
                         const messages::provider_endpoint_actor& endpoint) {
  return sys.spawn(vehicle_connection, std::move(setup), endpoint);
}

} // namespace sofof::actors
