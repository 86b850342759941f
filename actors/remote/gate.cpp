// Where processes of vehicles come in.
#include "actors/remote/gate.hpp"

#include "actors/remote/greeting.hpp"
#include "actors/remote/origin.hpp"
#include "actors/remote/session.hpp"
#include "actors/time.hpp"
#include "policies/rate_limit.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace sofof {

namespace {

/// So many may introduce themselves at a time; for one more the oldest goes,
/// for each process as well as for all.
constexpr std::size_t most_entrances = 256;
constexpr std::size_t most_entrances_of_one = 2;
constexpr std::size_t most_sessions_of_one = 16;
constexpr std::size_t most_claims = 10'000;

/// Between two notes of who was refused.
/// A peer that comes and goes all the time fills no journal.
constexpr double news_per_second = 1;
constexpr double news_at_once = 100;
constexpr duration refusal_note_period = std::chrono::seconds{1};

using entrance_impl = entrance_actor::extend<takes<tick_atom>>;
using gate_impl = gate_actor::extend<
    // An entrance of it has refused somebody for this reason.
    takes<tick_atom, std::string>,
    // One of them lets somebody of this name in.
    caf::result<peer_welcome, session_actor>(peer_hello, uplink_actor,
                                             std::string)>;

struct entrance_state {
  static inline const char* name = "entrance";

  entrance_impl::stateful_pointer<entrance_state> self = nullptr;
  gate_impl gate;
  std::shared_ptr<const gate_setup> setup;
  std::string nonce;
  bool is_used = false;

  // A gate lives long, and does not forget by itself who watched it.
  ~entrance_state() {
    if (self)
      self->demonitor(gate);
  }

  caf::result<peer_welcome, session_actor> take(const peer_hello& hello,
                                                const uplink_actor& peer) {
    const auto found = look_at(hello, peer);
    if (found.refusal) {
      if (!is_used)
        self->quit(); // whoever fails begins anew
      self->send(gate, tick_atom_v, *found.refusal);
      return caf::make_error(caf::sec::invalid_argument, *found.refusal);
    }
    is_used = true;
    auto promise = self->make_response_promise<peer_welcome, session_actor>();
    self->request(gate, caf::infinite, hello, peer, found.name)
        .then(
            [this, promise](const peer_welcome& welcome,
                            const session_actor& session) mutable {
              promise.deliver(welcome, session);
              self->quit();
            },
            [this, promise](caf::error& error) mutable {
              promise.deliver(std::move(error));
              self->quit();
            });
    return promise;
  }

  peer_finding look_at(const peer_hello& hello,
                       const uplink_actor& peer) const {
    if (const auto why = objection(hello, peer))
      return {{}, why};
    return setup->examine(hello, nonce);
  }

  std::optional<std::string> objection(const peer_hello& hello,
                                       const uplink_actor& peer) const {
    if (is_used)
      return "introduces itself twice";
    // It must not let a session of ours speak to our own actors.
    const auto& sender = self->current_sender();
    if (!peer || !sender || peer.node() != sender->node())
      return "it has no end of its own";
    if (hello.provider != setup->name)
      return fmt::format("it is provider {}", setup->name);
    if (hello.stations.empty() || hello.stations.size() > most_claims)
      return fmt::format("speaks for {} stations; 1 to {} are possible",
                         hello.stations.size(), most_claims);
    if (!is_time_of_day(hello.epoch_unix_ms))
      return "its clock shows no time of day";
    if (hello.world != setup->world)
      return fmt::format("provider {} has another map or other services; start "
                         "both sides with the same scenario file",
                         setup->name);
    return std::nullopt;
  }
};

entrance_impl::behavior_type
entrance(entrance_impl::stateful_pointer<entrance_state> self,
         const gate_impl& gate, std::shared_ptr<const gate_setup> setup,
         std::string nonce) {
  self->state.self = self;
  self->state.gate = gate;
  self->state.setup = std::move(setup);
  self->state.nonce = std::move(nonce);
  // It dies with the gate, but the gate not with it.
  self->monitor(gate);
  self->set_down_handler([self](const caf::down_msg&) { self->quit(); });
  send_after(self, self, protocol::introduction_timeout, tick_atom_v);
  self->set_default_handler(caf::drop); // from who is no peer of ours
  return {
      [self](const peer_hello& hello, const uplink_actor& peer) {
        return self->state.take(hello, peer);
      },
      [self](tick_atom) { self->quit(); },
  };
}

/// Somebody who may introduce himself.
struct newcomer {
  caf::strong_actor_ptr in; ///< His entrance.
  caf::node_id process;
};

/// Somebody who has been let in.
struct guest {
  session_actor session;
  std::string name;
  std::set<station_id> stations;
};

bool share_one(const std::set<station_id>& a, const std::set<station_id>& b) {
  return std::ranges::any_of(a, [&b](auto x) { return b.contains(x); });
}

struct gate_state {
  static inline const char* name = "gate";

  gate_impl::stateful_pointer<gate_state> self;
  std::shared_ptr<const gate_setup> setup;
  std::vector<newcomer> newcomers; // the oldest first
  std::vector<guest> guests;
  rate_limit chatter{news_per_second, news_at_once};
  std::uint64_t refused = 0;
  time_point next_complaint;

  // -- introductions --------------------------------------------------------

  /// @returns a number to sign, and where to do so.
  std::pair<std::string, caf::strong_actor_ptr> let_come() {
    const auto& who = self->current_sender();
    const auto process = who ? who->node() : caf::node_id{};
    std::string nonce;
    try {
      nonce = setup->draw_nonce();
    } catch (const std::exception& e) {
      note_refusal(e.what());
      return {};
    }
    make_room(process);
    const auto in = self->spawn(entrance, gate_impl{self}, setup, nonce);
    self->monitor(in);
    newcomers.push_back({caf::actor_cast<caf::strong_actor_ptr>(in), process});
    return {std::move(nonce), newcomers.back().in};
  }

  void make_room(const caf::node_id& process) {
    const auto same =
        std::ranges::count(newcomers, process, &newcomer::process);
    if (static_cast<std::size_t>(same) >= most_entrances_of_one)
      send_off(std::ranges::find(newcomers, process, &newcomer::process));
    else if (newcomers.size() >= most_entrances)
      send_off(newcomers.begin());
  }

  void send_off(std::vector<newcomer>::iterator at) {
    self->send_exit(caf::actor_cast<caf::actor>(at->in),
                    caf::exit_reason::user_shutdown);
    newcomers.erase(at);
  }

  // -- sessions -------------------------------------------------------------

  caf::result<peer_welcome, session_actor> admit(const peer_hello& hello,
                                                 const uplink_actor& peer,
                                                 const std::string& name) {
    const std::set<station_id> stations{hello.stations.begin(),
                                        hello.stations.end()};
    std::erase_if(guests, [&](const guest& other) {
      const auto is_replaced =
          other.name == name && share_one(other.stations, stations);
      if (is_replaced)
        self->send_exit(other.session, caf::exit_reason::user_shutdown);
      return is_replaced;
    });
    const auto there = std::ranges::count(guests, name, &guest::name);
    if (static_cast<std::size_t>(there) >= most_sessions_of_one) {
      const auto why =
          fmt::format("the certificate of {} has {} connections already, the "
                      "most it may have",
                      name, there);
      note_refusal(why);
      return caf::make_error(caf::sec::runtime_error, why);
    }
    const auto session =
        spawn_session(self->system(),
                      {setup->provider, peer, stations, setup->clock,
                       etsi::its_clock{hello.epoch_unix_ms}, setup->recorder});
    self->monitor(session);
    guests.push_back({session, name, stations});
    tell(stations, true);
    return {peer_welcome{setup->boot, setup->clock.epoch_unix_ms()}, session};
  }

  void gone(const caf::actor_addr& who) {
    if (who == setup->provider.address()) {
      // Nobody is left to be let in to.
      self->quit(caf::exit_reason::user_shutdown);
      return;
    }
    std::erase_if(newcomers, [&](const newcomer& x) { return x.in == who; });
    std::erase_if(guests, [&](const guest& x) {
      const auto is = x.session.address() == who;
      if (is)
        tell(x.stations, false);
      return is;
    });
  }

  // -- news -----------------------------------------------------------------

  void tell(const std::set<station_id>& stations, bool is_here) {
    if (chatter.take(now(self)))
      setup->on_peer(stations, is_here);
  }

  void note_refusal(const std::string& why) {
    ++refused;
    const auto t = now(self);
    if (t < next_complaint)
      return;
    next_complaint = t + refusal_note_period;
    self->send(setup->recorder,
               event_record{t,
                            "peer_refused",
                            0,
                            setup->boot,
                            {},
                            0,
                            fmt::format("{}; {} so far", why, refused)});
  }
};

gate_impl::behavior_type gate(gate_impl::stateful_pointer<gate_state> self,
                              gate_setup setup) {
  self->state.self = self;
  self->state.setup = std::make_shared<const gate_setup>(std::move(setup));
  self->monitor(self->state.setup->provider);
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.gone(down.source); });
  self->set_default_handler(caf::drop); // from who is no peer of ours
  return {
      [self](std::uint32_t protocol, std::uint64_t types) {
        return greet(protocol, types,
                     [self] { return self->state.let_come(); });
      },
      [self](tick_atom, const std::string& why) {
        if (is_from_here(self))
          self->state.note_refusal(why);
      },
      [self](
          const peer_hello& hello, const uplink_actor& peer,
          const std::string& name) -> caf::result<peer_welcome, session_actor> {
        if (!is_from_here(self))
          return caf::make_error(caf::sec::invalid_argument);
        return self->state.admit(hello, peer, name);
      },
  };
}

} // namespace

gate_actor spawn_gate(caf::actor_system& sys, gate_setup setup) {
  return sys.spawn(gate, std::move(setup));
}

} // namespace sofof
