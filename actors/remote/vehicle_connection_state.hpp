// What a connection to vehicles remembers, and does at each message.
#pragma once

#include "actors/remote/heartbeat.hpp"
#include "actors/remote/peer_rules.hpp"
#include "actors/remote/vehicle_connection.hpp"
#include "network/flow/conflating_queue.hpp"
#include "network/flow/sampled_log.hpp"

#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::actors {

/// A connection, as it sees itself.
using vehicle_connection_impl =
    vehicle_connection_actor::extend<messages::reacts_to<messages::tick_atom>>;

struct vehicle_connection_state {
  static inline const char* name = "vehicle_connection";

  vehicle_connection_impl::stateful_pointer<vehicle_connection_state> self;
  vehicle_connection_setup setup;
  messages::provider_endpoint_actor endpoint; // what the peer knows of us
  std::optional<peer_rules> rules;
  std::optional<heartbeat> life;
  std::map<station_id, messages::requester_actor> requesters;
  std::map<messages::session_id, messages::provider_manager_actor> managers;
  std::optional<
      network::conflating_queue<messages::stream_id, messages::service_result>>
      results;
  std::optional<time_point> ends_at; // once the provider has
  network::sampled_log dropped{std::chrono::seconds{1}};

  void start(vehicle_connection_setup with,
             const messages::provider_endpoint_actor& by);
  void on_tick();
  void on_down(const caf::down_msg& down);
  /// Its endpoint has ended: the stations were let in anew.
  void on_exit() { leave("replaced"); }

  // -- what the peer sends --------------------------------------------------

  void on_its_message(station_id station, const messages::its_pdu& message);
  void on_input(const messages::service_input& input);
  void on_request(const messages::service_request& request);
  void on_requester_end(const messages::service_end& e);
  void on_ping(const messages::ping& sign);
  void on_pong(const messages::pong& echo);
  void on_acknowledgement(const messages::stream_id& stream);
  /// Its endpoint has dropped something for this reason.
  void on_dropped(const std::string& why) { is_dropped(0, why); }

  // -- what the provider sends ----------------------------------------------

  void on_offer(station_id station, const messages::service_offer& offer);
  void on_digest(const messages::session_digest& digest);
  void on_response(const messages::service_response& response,
                   const std::vector<messages::provider_manager_actor>& given);
  void on_result(const messages::service_result& result);
  void on_provider_end(const messages::service_end& e);

private:
  bool is_heard();
  bool is_heard(station_id station);
  bool is_dropped(station_id station, std::string_view objection);
  void pass_on(station_id station, const messages::its_pdu& message);
  void pass_on(const messages::service_input& input);
  const messages::requester_actor& requester_of(station_id station);
  void forget(const messages::session_id& ended);
  void leave(std::string_view why);
  std::string stations() const;
  void log_event(messages::event_type what, station_id station,
                 std::string_view detail);

  template <class... Ts>
  void send_to_peer(const Ts&... xs) {
    caf::send_as(endpoint, setup.peer, xs...);
  }
};

} // namespace sofof::actors
