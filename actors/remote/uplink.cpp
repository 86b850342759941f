// The vehicles' end of a connection to a provider on another host.
#include "actors/remote/uplink.hpp"

#include "actors/remote/heartbeat.hpp"
#include "actors/remote/provider_connection.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "network/flow/conflating_queue.hpp"
#include "network/flow/exponential_backoff.hpp"
#include "network/flow/token_bucket.hpp"

#include <caf/event_based_actor.hpp>
#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace sofof {

namespace {

// Its handle never leaves the process. It is an uplink_mouth, too.
using uplink_impl = connection_user::extend<
    reacts_to<station_id, its_pdu>, reacts_to<service_request>,
    reacts_to<service_input>,
    // This station's messages go there.
    reacts_to<station_id, link_actor>,
    // Something may be due.
    reacts_to<tick_atom>,
    // It is this station's turn to speak.
    reacts_to<tick_atom, station_id>,
    // An attempt has got through, or has failed for this reason.
    reacts_to<tick_atom, gate_actor>, reacts_to<tick_atom, std::string>>;

constexpr std::size_t streams_of_station = 8;

/// Stations begin to speak so long after each other: all would ask at once, and
/// whoever begins to work for a hundred is late for those who came first.
constexpr duration between_stations = std::chrono::milliseconds{5};
constexpr duration all_stations = std::chrono::seconds{1}; ///< At most.

constexpr double told_s = 1;
constexpr double told_at_once = 20;

/// A refusal later than this is news.
constexpr duration beginning = std::chrono::seconds{5};

struct uplink_state {
  static inline const char* name = "uplink";

  uplink_impl::stateful_pointer<uplink_state> self;
  std::shared_ptr<const uplink_setup> setup;
  std::map<station_id, link_actor> vehicles;
  struct last_cam {
    its_pdu message;
    time_point said;
  };
  std::map<station_id, last_cam> cams;
  uplink_actor connection; // while we introduce ourselves, and afterwards
  // -- while connected
  session_actor session;
  provider_id boot = 0; // of the provider, the last one
  std::optional<heartbeat> life;
  bool is_heard = false;                  // it has asked for our clock
  std::map<station_id, time_point> turns; // those that have not come
  std::set<session_id> running;
  using word = std::variant<its_pdu, service_input>;
  std::optional<conflating_queue<stream_id, word>> words;
  // -- while not
  exponential_backoff pauses;
  std::uint64_t attempts = 0;
  time_point next_attempt;
  std::optional<time_point> trying_since;
  bool was_connected = false;
  time_point began;
  std::string last_news;
  token_bucket allowance{told_s, told_at_once}; // a provider may come and go

  void start() {
    words.emplace(streams_of_station * setup->stations.size(),
                  protocol::silence_limit);
    began = now(self);
    plan_attempt();
    tick();
  }

  void tick() {
    const auto t = now(self);
    if (session) {
      if (life->is_lost(t))
        disconnected("it has answered nothing for a second");
      else
        tell_session(life->beat(t));
    } else if (t >= next_attempt && !is_trying(t)) {
      attempt();
    }
    send_after(self, self, protocol::life_sign_period, tick_atom_v);
  }

  // -- connecting -----------------------------------------------------------

  void plan_attempt() {
    next_attempt = now(self) + pauses.next_wait(setup->noise.uniform(attempts));
    ++attempts;
  }

  // A second attempt would wait for the same connection as the first, and end
  // with it.
  bool is_trying(time_point t) const {
    return trying_since && t - *trying_since <= protocol::introduction_timeout;
  }

  void attempt() {
    trying_since = now(self);
    plan_attempt();
    auto helper = [connect = setup->connect, uplink = uplink_impl{self}] {
      const auto found = connect();
      if (const auto* gate = std::get_if<gate_actor>(&found))
        caf::send_as(uplink, uplink, tick_atom_v, *gate);
      else
        caf::send_as(uplink, uplink, tick_atom_v, std::get<std::string>(found));
    };
    if (setup->aside)
      setup->aside(std::move(helper));
    else
      self->system().spawn<caf::detached>(
          [helper = std::move(helper)](caf::event_based_actor*) { helper(); });
  }

  void failed(const std::string& why) {
    if (connection)
      return; // another attempt was faster
    trying_since.reset();
    tell(fmt::format("no connection to provider {} at {}: {}; trying again",
                     setup->provider, setup->address, why));
  }

  void introduce_to(const gate_actor& found) {
    if (!connection) // else another attempt was faster
      connection = spawn_connection(self->system(), found, setup,
                                    connection_user{uplink_impl{self}});
  }

  void not_let_in(const std::string& why, bool for_ever) {
    connection = nullptr;
    trying_since.reset();
    if (for_ever)
      refused(why);
    else
      failed(why);
  }

  // A vehicle goes on driving, even if nobody will ever plan for it; only who
  // has just begun would rather know.
  void refused(const std::string& why) {
    const auto news = fmt::format("provider {} at {} refuses: {}",
                                  setup->provider, setup->address, why);
    if (was_connected || now(self) - began > beginning)
      tell(news);
    else
      setup->on_refusal(news);
  }

  void connected(const peer_welcome& welcome, const session_actor& with) {
    trying_since.reset();
    was_connected = true;
    setup->on_connected();
    session = with;
    const auto t = now(self);
    life.emplace(t, std::chrono::milliseconds{welcome.epoch_unix_ms
                                              - setup->clock.epoch_unix_ms()});
    self->monitor(session);
    tell_session(life->beat(t));
    boot = welcome.boot;
    note(event_type::provider_connected, setup->address);
    tell(fmt::format("connected to provider {} at {}", setup->provider,
                     setup->address));
  }

  void disconnected(std::string_view why) {
    self->demonitor(session);
    session = nullptr;
    self->send_exit(connection, caf::exit_reason::user_shutdown);
    connection = nullptr;
    is_heard = false;
    turns.clear();
    life.reset();
    words->clear();
    setup->hang_up();
    plan_attempt();
    for (const auto& x : running)
      down(x.station, service_end{x, end_reason::peer_lost, side::provider});
    running.clear();
    note(event_type::provider_lost, why);
    tell(fmt::format("lost provider {} at {}: {}; vehicles plan for themselves",
                     setup->provider, setup->address, why));
  }

  void lost(const caf::actor_addr& who) {
    if (session && session.address() == who)
      disconnected("the connection is gone");
  }

  // -- what vehicles say ----------------------------------------------------

  void say(station_id station, const its_pdu& message) {
    const auto stream = stream_of(station, message);
    if (stream.of == stream_id::what::cam)
      cams.insert_or_assign(station, last_cam{message, now(self)});
    say(stream, word{message});
  }

  void say(const stream_id& stream, word what) {
    if (!is_heard || turns.contains(stream.station))
      return;
    if (auto next = words->offer(stream, std::move(what), now(self)))
      send(stream, *next);
  }

  void send(const stream_id& stream, const word& what) {
    if (const auto* message = std::get_if<its_pdu>(&what))
      tell_session(stream.station, *message);
    else
      tell_session(std::get<service_input>(what));
  }

  void acknowledge(const stream_id& stream) {
    if (auto next = words->acknowledge(stream, now(self)))
      send(stream, *next);
  }

  // Whose turn has not come is not connected yet.
  void ask(const service_request& request) {
    if (session && !turns.contains(request.station))
      tell_session(request);
  }

  void end(const service_end& e) {
    forget(e.running);
    if (session)
      tell_session(e);
  }

  void forget(const session_id& x) {
    running.erase(x);
    words->forget(stream_of(x, stream_id::what::input));
  }

  // -- what the provider says -----------------------------------------------

  // What an earlier connection said may still be under way.
  bool is_from_connection() {
    return connection
           && self->current_sender()
                  == caf::actor_cast<caf::strong_actor_ptr>(connection);
  }

  template <class... Ts>
  void tell_session(const Ts&... xs) {
    caf::send_as(connection, session, xs...);
  }

  template <class Message>
  void down(station_id station, const Message& message) {
    if (const auto i = vehicles.find(station); i != vehicles.end())
      self->send(i->second, message);
  }

  // By the answer the session knows our clock, and thus how old CAMs are.
  void answer(const ping& sign) {
    const auto t = now(self);
    tell_session(heartbeat::answer(sign, t));
    if (std::exchange(is_heard, true))
      return;
    auto turn = std::max(t, began + setup->rest);
    const auto n = static_cast<std::int64_t>(setup->stations.size());
    for (const auto station : setup->stations) {
      turns.insert_or_assign(station, turn);
      send_at(self, self, turn, tick_atom_v, station);
      turn += std::min(between_stations, all_stations / n);
    }
  }

  void begin_to_speak(station_id station) {
    const auto turn = turns.find(station);
    if (turn == turns.end() || now(self) < turn->second)
      return; // that was a turn of another connection
    turns.erase(turn);
    const auto last = cams.find(station);
    if (last != cams.end()
        && now(self) - last->second.said <= protocol::cam_timeout)
      say(stream_of(station, last->second.message), last->second.message);
  }

  // Who accepts at once and hangs up again has not succeeded.
  void take(const pong& echo) {
    life->take(echo, now(self));
    pauses.succeeded();
  }

  void take(station_id station, service_offer offer) {
    const auto clock = life->clock(now(self));
    if (clock && offer.created)
      *offer.created -= clock->ahead;
    else
      offer.created.reset();
    down(station, offer);
  }

  void take(const service_response& response) {
    const auto vehicle = vehicles.find(response.station);
    if (vehicle == vehicles.end())
      return;
    const auto most = streams_of_station * setup->stations.size();
    for (const auto& v : response.verdicts)
      if (v.accepted && v.running.station == response.station
          && running.size() < most)
        running.insert(v.running);
    // Of the link type: how many managers there are is told by the verdicts.
    self->send(vehicle->second, response,
               std::vector<provider_manager_actor>{});
  }

  void take(const service_result& result) {
    hand_on(result);
    tell_session(stream_of(result.running, stream_id::what::result));
  }

  void hand_on(const service_result& result) {
    const auto t = now(self);
    const auto clock = life->clock(t);
    if (!clock)
      return;
    auto here = result;
    here.doubt = clock->doubt;
    here.created -= clock->ahead;
    // By less than our doubt, it may seem to come from the future.
    if (here.created > t && here.created - t <= clock->doubt)
      here.created = t;
    if (const auto message = result.what.as<its_pdu>())
      here.what =
          payload::of(its_pdu{message->octets, life->time_of_day(*clock)});
    down(here.running.station, here);
  }

  void tell_end(const service_end& e) {
    forget(e.running);
    down(e.running.station, e);
  }

  // -- news -----------------------------------------------------------------

  void tell(const std::string& news) {
    if (news == last_news || !allowance.take(now(self)))
      return;
    last_news = news;
    setup->on_news(news);
  }

  void note(event_type what, std::string_view detail) {
    send_record(
        self, setup->recorder,
        event_record{now(self), what, 0, boot, {}, 0, std::string{detail}});
  }
};

uplink_impl::behavior_type
uplink(uplink_impl::stateful_pointer<uplink_state> self, uplink_setup setup) {
  self->state.self = self;
  self->state.setup = std::make_shared<const uplink_setup>(std::move(setup));
  self->state.start();
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.lost(down.source); });
  return {
      [self](station_id station, const service_offer& offer) {
        if (self->state.is_from_connection())
          self->state.take(station, offer);
      },
      [self](const service_response& response) {
        if (self->state.is_from_connection())
          self->state.take(response);
      },
      [self](const service_result& result) {
        if (self->state.is_from_connection())
          self->state.take(result);
      },
      [self](const service_end& e) {
        if (e.from == side::provider && self->state.is_from_connection())
          self->state.tell_end(e);
        else if (e.from == side::requester)
          self->state.end(e);
      },
      [self](const ping& sign) {
        if (self->state.is_from_connection())
          self->state.answer(sign);
      },
      [self](const pong& echo) {
        if (self->state.is_from_connection())
          self->state.take(echo);
      },
      [self](const stream_id& stream) {
        if (self->state.is_from_connection())
          self->state.acknowledge(stream);
      },
      [self](station_id station, const its_pdu& message) {
        self->state.say(station, message);
      },
      [self](const service_request& request) { self->state.ask(request); },
      [self](const service_input& input) {
        self->state.say(stream_of(input.running, stream_id::what::input),
                        input);
      },
      [self](station_id station, const link_actor& vehicle) {
        self->state.vehicles.insert_or_assign(station, vehicle);
      },
      [self](tick_atom) { self->state.tick(); },
      [self](tick_atom, station_id station) {
        self->state.begin_to_speak(station);
      },
      [self](const peer_welcome& welcome, const session_actor& session) {
        if (self->state.is_from_connection())
          self->state.connected(welcome, session);
      },
      [self](const std::string& why, bool for_ever) {
        if (self->state.is_from_connection())
          self->state.not_let_in(why, for_ever);
      },
      [self](tick_atom, const gate_actor& gate) {
        self->state.introduce_to(gate);
      },
      [self](tick_atom, const std::string& why) { self->state.failed(why); },
  };
}

} // namespace

uplink_mouth spawn_uplink(caf::actor_system& sys, uplink_setup setup) {
  return sys.spawn(uplink, std::move(setup));
}

void introduce(const uplink_mouth& uplink, station_id station,
               const link_actor& provider_proxy) {
  caf::anon_send(caf::actor_cast<uplink_impl>(uplink), station, provider_proxy);
}

} // namespace sofof
