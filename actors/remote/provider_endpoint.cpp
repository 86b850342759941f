// It passes on what the peer sends, and nothing else.
#include "actors/remote/provider_endpoint.hpp"

#include "actors/remote/vehicle_connection.hpp"

#include <caf/typed_event_based_actor.hpp>

namespace sofof::actors {

namespace {

messages::provider_endpoint_actor::behavior_type
provider_endpoint(messages::provider_endpoint_actor::pointer self,
                  vehicle_connection_setup setup) {
  const auto peer = caf::actor_cast<caf::strong_actor_ptr>(setup.peer);
  const auto connection =
      spawn_vehicle_connection(self->system(), std::move(setup),
                               messages::provider_endpoint_actor{self});
  self->link_to(connection); // they end together
  // What no interface has is dropped.
  self->set_default_handler(caf::drop);
  self->set_down_handler([](const caf::down_msg&) {});
  const auto pass_on = [self, peer, connection](const auto&... xs) {
    if (self->current_sender() == peer)
      self->send(connection, xs...);
    else
      self->send(connection, std::string{"a stranger speaks"});
  };
  return {
      [=](station_id::rep station, const messages::its_pdu& message) {
        pass_on(station, message);
      },
      [=](const messages::service_request& request) { pass_on(request); },
      [=](const messages::service_input& input) { pass_on(input); },
      [=](const messages::service_end& end) {
        if (end.from == messages::side::requester)
          pass_on(end);
      },
      [=](const messages::ping& sign) { pass_on(sign); },
      [=](const messages::pong& echo) { pass_on(echo); },
      [=](const messages::stream_id& stream) { pass_on(stream); },
  };
}

} // namespace

messages::provider_endpoint_actor
spawn_provider_endpoint(caf::actor_system& sys,
                        vehicle_connection_setup setup) {
  return sys.spawn(provider_endpoint, std::move(setup));
}

} // namespace sofof::actors
