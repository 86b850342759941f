// What crosses a connection between a provider and vehicles on another host.
#include "actors/remote/clock_translation.hpp"
#include "actors/remote/requester_proxy.hpp"
#include "actors/remote/vehicle_connection_state.hpp"
#include "actors/runtime/time.hpp"

#include <utility>

namespace sofof::actors {

// -- what the peer sends ----------------------------------------------------

bool vehicle_connection_state::is_heard() {
  return !is_dropped(0, rules->objection_to_message(now(self)));
}

bool vehicle_connection_state::is_heard(station_id station) {
  return is_heard()
         && !is_dropped(station, rules->objection_to_sender(station));
}

/// @param objection  Empty: there is none.
bool vehicle_connection_state::is_dropped(station_id station,
                                          std::string_view objection) {
  if (objection.empty())
    return false;
  if (const auto line = dropped.add(objection, now(self)))
    log_event(messages::event_type::peer_ignored, station, *line);
  return true;
}

// What is dropped for its contents is acknowledged, too: its stream would stop
// for a while. What is passed on goes first.
void vehicle_connection_state::on_its_message(
    station_id station, const messages::its_pdu& message) {
  if (!is_heard(station))
    return;
  pass_on(station, message);
  send_to_peer(messages::stream_of(station, message));
}

void vehicle_connection_state::on_input(const messages::service_input& input) {
  if (!is_heard(input.session.station))
    return;
  pass_on(input);
  send_to_peer(
      messages::stream_of(input.session, messages::stream_id::what::input));
}

void vehicle_connection_state::pass_on(station_id station,
                                       const messages::its_pdu& message) {
  const auto t = now(self);
  if (is_dropped(station, rules->objection_to(station, message, t)))
    return;
  auto here = on_our_clock(message, *life, t);
  if (!here)
    return;
  here->sender = setup.sender;
  self->send(setup.provider, std::move(*here), requester_of(station));
}

void vehicle_connection_state::pass_on(const messages::service_input& input) {
  const auto t = now(self);
  if (is_dropped(input.session.station, rules->objection_to(input, t)))
    return;
  const auto manager = managers.find(input.session);
  if (manager == managers.end())
    return;
  if (auto here = on_our_clock(input, *life, t))
    self->send(manager->second, std::move(*here));
}

void vehicle_connection_state::on_request(
    const messages::service_request& request) {
  if (is_heard(request.station)
      && !is_dropped(request.station, rules->objection_to(request)))
    self->send(setup.provider, request, requester_of(request.station));
}

void vehicle_connection_state::on_requester_end(
    const messages::service_end& e) {
  if (!is_heard(e.session.station))
    return;
  forget(e.session);
  self->send(setup.provider, e);
}

void vehicle_connection_state::on_ping(const messages::ping& sign) {
  if (is_heard())
    send_to_peer(heartbeat::answer(sign, now(self)));
}

void vehicle_connection_state::on_pong(const messages::pong& echo) {
  if (is_heard())
    life->on_pong(echo, now(self));
}

void vehicle_connection_state::on_acknowledgement(
    const messages::stream_id& stream) {
  if (!is_heard())
    return;
  if (const auto next = results->acknowledge(stream, now(self)))
    send_to_peer(*next);
}

/// @returns whom the provider knows as this station's requester.
const messages::requester_actor&
vehicle_connection_state::requester_of(station_id station) {
  auto& requester = requesters[station];
  if (!requester)
    requester = spawn_requester_proxy(self->system(), station,
                                      vehicle_connection_impl{self});
  return requester;
}

// -- what the provider sends ------------------------------------------------

void vehicle_connection_state::on_offer(station_id station,
                                        const messages::service_offer& offer) {
  send_to_peer(station.value(), offer);
}

void vehicle_connection_state::on_digest(
    const messages::session_digest& digest) {
  send_to_peer(digest);
}

void vehicle_connection_state::on_response(
    const messages::service_response& response,
    const std::vector<messages::provider_manager_actor>& given) {
  auto manager = given.begin();
  for (const auto& v : response.verdicts)
    if (v.accepted && manager != given.end())
      managers.insert_or_assign(v.session, *manager++);
  send_to_peer(response);
}

void vehicle_connection_state::on_result(
    const messages::service_result& result) {
  const auto stream =
      messages::stream_of(result.session, messages::stream_id::what::result);
  if (const auto next = results->offer(stream, result, now(self)))
    send_to_peer(*next);
}

void vehicle_connection_state::on_provider_end(const messages::service_end& e) {
  forget(e.session);
  send_to_peer(e);
}

void vehicle_connection_state::forget(const messages::session_id& ended) {
  managers.erase(ended);
  results->forget(
      messages::stream_of(ended, messages::stream_id::what::result));
}

} // namespace sofof::actors
