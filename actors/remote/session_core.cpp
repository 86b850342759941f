// What a session does with what its peer says, and with what the provider says.
#include "actors/remote/session_core.hpp"

#include "actors/remote/heartbeat.hpp"
#include "actors/remote/requester_proxy.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "network/flow/conflating_queue.hpp"
#include "network/flow/token_bucket.hpp"
#include "network/keys/identity.hpp"

#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

namespace sofof {

namespace {

using namespace std::chrono_literals;

using session_impl = session_core_actor::extend<reacts_to<tick_atom>>;

/// What a station may say a second: CAMs, CPMs and inputs at 10 Hz or 20. The
/// protocol's few words go beside that.
constexpr double words_per_station_s = 100;
/// What a peer may say beyond that: credits for each of its stations, and signs
/// of life.
constexpr double credits_per_station_s = 100;
constexpr double signs_s = 200;
/// So long a session outlives its provider, to hand on what it said last.
constexpr duration last_words = 50ms;
/// For what was held up and comes at once.
constexpr double burst_s = 2;
constexpr std::size_t streams_per_station = 8;
constexpr std::size_t longest_route = 1000;
constexpr std::size_t most_kinds = 64;
/// Between two notes of what was dropped.
constexpr duration complaint_period = 1s;

struct session_state {
  static inline const char* name = "session";

  session_impl::stateful_pointer<session_state> self;
  session_setup setup;
  session_actor endpoint; // what the peer sends to, and hears
  std::optional<heartbeat> life;
  std::map<station_id, token_bucket> allowances;
  std::map<station_id, requester_actor> voices;
  std::map<session_id, provider_manager_actor> managers;
  std::optional<conflating_queue<stream_id, service_result>> results;
  std::optional<token_bucket> attention; // for all that the peer says
  std::optional<time_point> ends_at;     // once the provider has
  time_point next_complaint;
  std::uint64_t dropped = 0;

  void start() {
    const auto t = now(self);
    life.emplace(t, std::chrono::milliseconds{setup.peer_clock.epoch_unix_ms()
                                              - setup.clock.epoch_unix_ms()});
    for (const auto station : setup.stations)
      allowances.try_emplace(station, words_per_station_s,
                             burst_s * words_per_station_s);
    const auto words_s = signs_s
                         + (words_per_station_s + credits_per_station_s)
                               * static_cast<double>(setup.stations.size());
    attention.emplace(words_s, burst_s * words_s);
    results.emplace(streams_per_station * setup.stations.size(),
                    protocol::silence_limit);
    self->monitor(setup.peer);
    self->monitor(setup.provider);
    note(event_type::peer_connected, 0, stations());
    tick();
  }

  // -- who speaks -----------------------------------------------------------

  template <class... Ts>
  void tell_peer(const Ts&... xs) {
    caf::send_as(endpoint, setup.peer, xs...);
  }

  bool is_heard() {
    const auto is = attention->take(now(self));
    if (!is)
      drop(0, "the peer says too much");
    return is;
  }

  bool speaks_for(station_id station) {
    if (!is_heard())
      return false;
    const auto does = setup.stations.contains(station);
    if (!does)
      drop(station, "speaks for another station");
    return does;
  }

  bool is_allowed(station_id station) {
    const auto is = allowances.at(station).take(now(self));
    if (!is)
      drop(station, "says too much");
    return is;
  }

  void drop(station_id station, std::string_view why) {
    ++dropped;
    const auto t = now(self);
    if (t < next_complaint)
      return;
    next_complaint = t + complaint_period;
    note(event_type::peer_ignored, station,
         fmt::format("{}; {} so far", why, dropped));
  }

  const requester_actor& voice_of(station_id station) {
    auto& voice = voices[station];
    if (!voice)
      voice = spawn_far_requester(self->system(), station, session_impl{self});
    return voice;
  }

  // -- what the peer says ---------------------------------------------------

  // What is dropped is acknowledged, too: its stream would stop for a while.
  // What is not goes first.
  void take(station_id station, const its_pdu& message) {
    if (!speaks_for(station))
      return;
    hand_on(station, message);
    tell_peer(stream_of(station, message));
  }
  void take(const service_input& input) {
    if (!speaks_for(input.running.station))
      return;
    hand_on(input);
    tell_peer(stream_of(input.running, stream_id::what::input));
  }

  void hand_on(station_id station, const its_pdu& message) {
    if (!is_allowed(station))
      return;
    if (message.station() != station) {
      drop(station, "carries another station's message");
      return;
    }
    if (const auto clock = life->clock(now(self)))
      self->send(
          setup.provider,
          its_pdu{message.octets, life->time_of_day(*clock), setup.sender},
          voice_of(station));
  }

  void take(const service_request& request) {
    if (!speaks_for(request.station))
      return;
    if (request.route.size() > longest_route
        || request.kinds.size() > most_kinds
        || request.candidates.size() > protocol::most_candidates)
      drop(request.station, "asks for too much");
    else
      self->send(setup.provider, request, voice_of(request.station));
  }

  void hand_on(const service_input& input) {
    if (!is_allowed(input.running.station))
      return;
    const auto manager = managers.find(input.running);
    const auto clock = life->clock(now(self));
    if (manager == managers.end() || !clock)
      return;
    auto here = input;
    here.at -= clock->ahead;
    if (const auto message = input.what.as<its_pdu>())
      here.what =
          payload::of(its_pdu{message->octets, life->time_of_day(*clock)});
    self->send(manager->second, std::move(here));
  }

  void end(const service_end& e) {
    if (!speaks_for(e.running.station))
      return;
    forget(e.running);
    self->send(setup.provider, e);
  }

  // -- what the provider says -----------------------------------------------

  void take(const service_response& response,
            const std::vector<provider_manager_actor>& given) {
    auto manager = given.begin();
    for (const auto& v : response.verdicts)
      if (v.accepted && manager != given.end())
        managers.insert_or_assign(v.running, *manager++);
    tell_peer(response);
  }

  void take(const service_result& result) {
    const auto stream = stream_of(result.running, stream_id::what::result);
    if (const auto next = results->offer(stream, result, now(self)))
      tell_peer(*next);
  }

  void acknowledge(const stream_id& stream) {
    if (const auto next = results->acknowledge(stream, now(self)))
      tell_peer(*next);
  }

  void tell_end(const service_end& e) {
    forget(e.running);
    tell_peer(e);
  }

  void forget(const session_id& running) {
    managers.erase(running);
    results->forget(stream_of(running, stream_id::what::result));
  }

  // -- the connection -------------------------------------------------------

  void tick() {
    const auto t = now(self);
    if (ends_at && t >= *ends_at) {
      leave("the provider has ended");
      return;
    }
    if (life->is_lost(t)) {
      leave("silent");
      return;
    }
    tell_peer(life->beat(t));
    send_after(self, self, protocol::life_sign_period, tick_atom_v);
  }

  void lost(const caf::down_msg& down) {
    const auto provider = down.source == setup.provider.address();
    if (provider && down.reason == caf::exit_reason::user_shutdown)
      ends_at = now(self) + last_words; // they are still to be handed on
    else if (provider || down.source == setup.peer.address())
      leave("gone");
  }

  void leave(std::string_view why) {
    note(event_type::peer_lost, 0, fmt::format("{}: {}", stations(), why));
    self->quit(caf::exit_reason::remote_link_unreachable);
  }

  /// @returns e.g. "stations 101-106".
  std::string stations() const {
    return describe({{setup.stations.begin(), setup.stations.end()}, {}});
  }

  void note(event_type what, station_id station, std::string_view detail) {
    send_record(
        self, setup.recorder,
        event_record{now(self), what, station, 0, {}, 0, std::string{detail}});
  }
};

session_impl::behavior_type
session_core(session_impl::stateful_pointer<session_state> self,
             session_setup setup, const session_actor& endpoint) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  self->state.endpoint = endpoint;
  self->state.start();
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.lost(down); });
  // Its endpoint has ended: the stations were let in anew.
  self->set_exit_handler(
      [self](const caf::exit_msg&) { self->state.leave("replaced"); });
  return {
      [self](station_id station, const its_pdu& message) {
        self->state.take(station, message);
      },
      [self](const service_request& request) { self->state.take(request); },
      [self](const service_input& input) { self->state.take(input); },
      [self](const service_end& e) {
        if (e.from == side::requester)
          self->state.end(e);
        else
          self->state.tell_end(e);
      },
      [self](const ping& sign) {
        if (self->state.is_heard())
          self->state.tell_peer(heartbeat::answer(sign, now(self)));
      },
      [self](const pong& echo) {
        if (self->state.is_heard())
          self->state.life->take(echo, now(self));
      },
      [self](const stream_id& stream) {
        if (self->state.is_heard())
          self->state.acknowledge(stream);
      },
      [self](station_id station, const service_offer& offer) {
        self->state.tell_peer(station, offer);
      },
      [self](const service_response& response,
             const std::vector<provider_manager_actor>& managers) {
        self->state.take(response, managers);
      },
      [self](const service_result& result) { self->state.take(result); },
      [self](tick_atom) { self->state.tick(); },
      [self](const std::string& why) { self->state.drop(0, why); },
  };
}

} // namespace

session_core_actor spawn_session_core(caf::actor_system& sys,
                                      session_setup setup,
                                      const session_actor& endpoint) {
  return sys.spawn(session_core, std::move(setup), endpoint);
}

} // namespace sofof
