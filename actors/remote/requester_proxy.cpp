// A requester on another host, as a provider sees it.
#include "actors/remote/requester_proxy.hpp"

#include <caf/typed_event_based_actor.hpp>

namespace sofof {

namespace {

requester_actor::behavior_type requester_proxy(requester_actor::pointer self,
                                               station_id station,
                                               const session_mouth& session) {
  self->link_to(session);
  return {
      [=](const service_result& result) { self->send(session, result); },
      [=](const service_offer& offer) { self->send(session, station, offer); },
      [=](const service_response& response,
          const std::vector<provider_manager_actor>& managers) {
        self->send(session, response, managers);
      },
      [=](const service_end& end) { self->send(session, end); },
  };
}

} // namespace

requester_actor spawn_far_requester(caf::actor_system& sys, station_id station,
                                    const session_mouth& session) {
  return sys.spawn(requester_proxy, station, session);
}

} // namespace sofof
