// What a connection to a provider remembers, and does at each message.
#pragma once

#include "actors/remote/heartbeat.hpp"
#include "actors/remote/outgoing_traffic.hpp"
#include "actors/remote/provider_connection.hpp"
#include "actors/remote/vehicle_endpoint.hpp"
#include "network/flow/dial_schedule.hpp"
#include "network/flow/news_filter.hpp"

#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace sofof::actors {

/// A connection, as it sees itself; this handle never leaves the process. It is
/// a provider_outbox, too.
using provider_connection_impl = vehicle_endpoint_owner::extend<
    messages::reacts_to<station_id::rep, messages::its_pdu>,
    messages::reacts_to<messages::service_request>,
    messages::reacts_to<messages::service_input>,
    // This station's messages go there.
    messages::reacts_to<station_id::rep, messages::link_actor>,
    // Something may be due.
    messages::reacts_to<messages::tick_atom>,
    // It is this station's turn to begin.
    messages::reacts_to<messages::tick_atom, station_id::rep>,
    // An attempt has got through, or has failed for this reason.
    messages::reacts_to<messages::tick_atom, messages::acceptor_actor>,
    messages::reacts_to<messages::tick_atom, std::string>>;

struct provider_connection_state {
  static inline const char* name = "provider_connection";

  provider_connection_impl::stateful_pointer<provider_connection_state> self;
  std::shared_ptr<const provider_connection_setup> setup;
  std::map<station_id, messages::link_actor> vehicles;
  std::optional<network::dial_schedule> attempts;
  std::optional<outgoing_traffic> traffic;
  network::news_filter news;
  time_point began;
  bool was_connected = false;
  provider_id provider = 0;                  // since its last start
  messages::vehicle_endpoint_actor endpoint; // from our introduction on
  // While connected:
  messages::provider_endpoint_actor peer;
  std::optional<heartbeat> life;
  std::set<messages::session_id> running;

  void start(provider_connection_setup with);
  void on_tick();

  // -- connecting -----------------------------------------------------------

  void on_attempt_failed(const std::string& why);
  void on_acceptor(const messages::acceptor_actor& found);
  void on_welcome(const messages::peer_welcome& welcome,
                  const messages::provider_endpoint_actor& with);
  void on_refusal(const std::string& why, bool for_ever);
  void on_down(const caf::actor_addr& who);

  /// @returns whether a message has come by the connection that there is; what
  /// an earlier one brought may still be under way.
  bool is_from_connection();

  // -- what vehicles send ---------------------------------------------------

  void on_its_message(station_id station, const messages::its_pdu& message);
  void on_input(const messages::service_input& input);
  void on_turn(station_id station);
  void on_request(const messages::service_request& request);
  void on_requester_end(const messages::service_end& e);

  // -- what the provider sends ----------------------------------------------

  void on_ping(const messages::ping& sign);
  void on_pong(const messages::pong& echo);
  void on_acknowledgement(const messages::stream_id& stream);
  void on_offer(station_id station, const messages::service_offer& offer);
  void on_response(const messages::service_response& response);
  void on_digest(const messages::session_digest& digest);
  void on_result(const messages::service_result& result);
  void on_provider_end(const messages::service_end& e);

private:
  void attempt();
  void disconnect(std::string_view why);
  void forget(const messages::session_id& ended);
  void publish(const std::string& sentence);
  void log_event(messages::event_type what, std::string_view detail);

  template <class... Ts>
  void send_to_provider(const Ts&... xs) {
    caf::send_as(endpoint, peer, xs...);
  }
  void send_next(const std::optional<outgoing_traffic::message>& next);

  template <class Message>
  void send_to_vehicle(station_id station, const Message& message) {
    if (const auto i = vehicles.find(station); i != vehicles.end())
      self->send(i->second, message);
  }
};

} // namespace sofof::actors
