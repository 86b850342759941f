// A requester on another host, as a provider sees it.
#include "actors/remote/requester_proxy.hpp"

#include <caf/typed_event_based_actor.hpp>

namespace sofof {

namespace {

requester_actor::behavior_type requester_proxy(requester_actor::pointer self,
                                               station_id station,
                                               const vehicle_outbox& outbox) {
  self->link_to(outbox);
  return {
      [=](const service_result& result) { self->send(outbox, result); },
      [=](const service_offer& offer) {
        self->send(outbox, station.value(), offer);
      },
      [=](const service_response& response,
          const std::vector<provider_manager_actor>& managers) {
        self->send(outbox, response, managers);
      },
      [=](const service_end& end) { self->send(outbox, end); },
  };
}

} // namespace

requester_actor spawn_requester_proxy(caf::actor_system& sys,
                                      station_id station,
                                      const vehicle_outbox& outbox) {
  return sys.spawn(requester_proxy, station, outbox);
}

} // namespace sofof
