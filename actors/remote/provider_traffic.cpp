// What crosses a connection between vehicles and a provider on another host.
#include "actors/remote/clock_translation.hpp"
#include "actors/remote/provider_connection_state.hpp"
#include "actors/runtime/time.hpp"

#include <algorithm>
#include <vector>

namespace sofof::actors {

// -- what vehicles send -----------------------------------------------------

void provider_connection_state::send_next(
    const std::optional<outgoing_traffic::message>& next) {
  if (!next)
    return;
  if (const auto* x = std::get_if<outgoing_traffic::its_message>(&*next))
    send_to_provider(x->station.value(), x->content);
  else
    send_to_provider(std::get<messages::service_input>(*next));
}

void provider_connection_state::on_its_message(
    station_id station, const messages::its_pdu& message) {
  send_next(traffic->offer(station, message, now(self)));
}

void provider_connection_state::on_input(const messages::service_input& input) {
  send_next(traffic->offer(input, now(self)));
}

void provider_connection_state::on_turn(station_id station) {
  send_next(traffic->begin(station, now(self)));
}

void provider_connection_state::on_request(
    const messages::service_request& request) {
  if (peer && !traffic->is_waiting(request.station))
    send_to_provider(request);
}

void provider_connection_state::on_requester_end(
    const messages::service_end& e) {
  forget(e.session);
  if (peer)
    send_to_provider(e);
}

void provider_connection_state::forget(const messages::session_id& ended) {
  running.erase(ended);
  traffic->forget(ended);
}

// -- what the provider sends ------------------------------------------------

// By the answer the provider knows our clock, and thus how old CAMs are.
void provider_connection_state::on_ping(const messages::ping& sign) {
  const auto t = now(self);
  send_to_provider(heartbeat::answer(sign, t));
  if (traffic->is_open())
    return;
  for (const auto& turn : traffic->open(std::max(t, began + setup->rest)))
    send_at(self, self, turn.at, messages::tick_atom_v, turn.station.value());
}

void provider_connection_state::on_pong(const messages::pong& echo) {
  life->on_pong(echo, now(self));
  attempts->succeeded();
}

void provider_connection_state::on_acknowledgement(
    const messages::stream_id& stream) {
  send_next(traffic->acknowledge(stream, now(self)));
}

void provider_connection_state::on_offer(station_id station,
                                         const messages::service_offer& offer) {
  send_to_vehicle(station, on_our_clock(offer, *life, now(self)));
}

void provider_connection_state::on_response(
    const messages::service_response& response) {
  const auto vehicle = vehicles.find(response.station);
  if (vehicle == vehicles.end())
    return;
  const auto most =
      outgoing_traffic::streams_per_station * setup->stations.size();
  for (const auto& v : response.verdicts)
    if (v.accepted && v.session.station == response.station
        && running.size() < most)
      running.insert(v.session);
  // Of the link type: how many managers there are is told by the verdicts.
  self->send(vehicle->second, response,
             std::vector<messages::provider_manager_actor>{});
}

void provider_connection_state::on_digest(
    const messages::session_digest& digest) {
  send_to_vehicle(digest.station, digest);
}

void provider_connection_state::on_result(
    const messages::service_result& result) {
  if (const auto here = on_our_clock(result, *life, now(self)))
    send_to_vehicle(here->session.station, *here);
  send_to_provider(
      messages::stream_of(result.session, messages::stream_id::what::result));
}

void provider_connection_state::on_provider_end(
    const messages::service_end& e) {
  forget(e.session);
  send_to_vehicle(e.session.station, e);
}

} // namespace sofof::actors
