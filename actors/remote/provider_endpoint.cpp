// The end of a connection that the peer can reach: it passes on what the peer
// says, and nothing else.
#include "actors/remote/provider_endpoint.hpp"

#include "actors/remote/vehicle_connection.hpp"

#include <caf/typed_event_based_actor.hpp>

namespace sofof {

namespace {

session_actor::behavior_type session(session_actor::pointer self,
                                     session_setup setup) {
  const auto peer = caf::actor_cast<caf::strong_actor_ptr>(setup.peer);
  const auto core =
      spawn_session_core(self->system(), std::move(setup), session_actor{self});
  self->link_to(core); // they end together
  // Nor does it hear what no interface has.
  self->set_default_handler(caf::drop);
  self->set_down_handler([](const caf::down_msg&) {});
  const auto pass_on = [self, peer, core](const auto&... xs) {
    if (self->current_sender() == peer)
      self->send(core, xs...);
    else
      self->send(core, std::string{"a stranger speaks"});
  };
  return {
      [=](station_id station, const its_pdu& message) {
        pass_on(station, message);
      },
      [=](const service_request& request) { pass_on(request); },
      [=](const service_input& input) { pass_on(input); },
      [=](const service_end& end) {
        if (end.from == side::requester)
          pass_on(end);
      },
      [=](const ping& sign) { pass_on(sign); },
      [=](const pong& echo) { pass_on(echo); },
      [=](const stream_id& stream) { pass_on(stream); },
  };
}

} // namespace

session_actor spawn_session(caf::actor_system& sys, session_setup setup) {
  return sys.spawn(session, std::move(setup));
}

} // namespace sofof
