// What a selector tells its watchdog.
#include "actors/offloading/selector_links.hpp"

#include <caf/typed_event_based_actor.hpp>

namespace sofof::actors {

void selector_links::watch(const messages::session_id& session,
                           time_point last) {
  self_->send(watchdog_, session, last);
}

void selector_links::watch_arrival(const messages::arrival& result) {
  self_->send(watchdog_, result);
}

void selector_links::watch_useless(const messages::session_id& session,
                                   const messages::implausibility& found) {
  self_->send(watchdog_, session, found.why, found.check);
}

void selector_links::watch_limits(const messages::qos_limits& limits) {
  self_->send(watchdog_, limits);
}

void selector_links::watch_end(const messages::service_end& end) {
  self_->send(watchdog_, end);
}

} // namespace sofof::actors
