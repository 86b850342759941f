// A requester on another host, as a provider sees it.
#include "actors/remote/requester_proxy.hpp"

#include <caf/typed_event_based_actor.hpp>

namespace sofof::actors {

namespace {

messages::requester_actor::behavior_type
requester_proxy(messages::requester_actor::pointer self, station_id station,
                const vehicle_outbox& outbox) {
  self->link_to(outbox);
  return {
      [=](const messages::service_result& result) {
        self->send(outbox, result);
      },
      [=](const messages::service_offer& offer) {
        self->send(outbox, station.value(), offer);
      },
      [=](const messages::session_digest& digest) {
        self->send(outbox, digest);
      },
      [=](const messages::service_response& response,
          const std::vector<messages::provider_manager_actor>& managers) {
        self->send(outbox, response, managers);
      },
      [=](const messages::service_end& end) { self->send(outbox, end); },
  };
}

} // namespace

messages::requester_actor spawn_requester_proxy(caf::actor_system& sys,
                                                station_id station,
                                                const vehicle_outbox& outbox) {
  return sys.spawn(requester_proxy, station, outbox);
}

} // namespace sofof::actors
