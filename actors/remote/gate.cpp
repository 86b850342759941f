// Where processes of vehicles come in.
#include "actors/remote/gate.hpp"

#include "actors/remote/origin.hpp"
#include "actors/remote/session.hpp"
#include "actors/remote/type_block.hpp"
#include "actors/time.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <memory>

namespace sofof {

namespace {

/// So many may introduce themselves at a time.
constexpr std::size_t most_entrances = 64;
constexpr std::size_t most_stations = 10'000;

/// Between two notes of who was refused.
constexpr duration complaint_period = std::chrono::seconds{1};

using entrance_impl = entrance_actor::extend<takes<tick_atom>>;
using gate_impl = gate_actor::extend<
    // An entrance of it has refused somebody for this reason.
    takes<tick_atom, std::string>>;

struct entrance_state {
  static inline const char* name = "entrance";

  entrance_impl::stateful_pointer<entrance_state> self = nullptr;
  gate_impl gate;
  std::shared_ptr<const gate_setup> setup;
  std::string nonce;

  // A gate lives long, and does not forget by itself who watched it.
  ~entrance_state() {
    if (self)
      self->demonitor(gate);
  }

  caf::result<peer_welcome, session_actor> take(const peer_hello& hello,
                                                const uplink_actor& peer) {
    self->quit(); // whoever fails begins anew
    if (const auto why = objection(hello, peer)) {
      self->send(gate, tick_atom_v, *why);
      return caf::make_error(caf::sec::invalid_argument, *why);
    }
    const auto session = spawn_session(
        self->system(),
        {setup->provider, peer,
         std::set<station_id>{hello.stations.begin(), hello.stations.end()},
         setup->clock, etsi::its_clock{hello.epoch_unix_ms}, setup->recorder});
    return {
        peer_welcome{setup->boot, setup->name, setup->clock.epoch_unix_ms()},
        session};
  }

  std::optional<std::string> objection(const peer_hello& hello,
                                       const uplink_actor& peer) const {
    // It must not let a session of ours speak to our own actors.
    const auto& sender = self->current_sender();
    if (!peer || !sender || peer.node() != sender->node())
      return "it has no end of its own";
    if (hello.stations.empty() || hello.stations.size() > most_stations)
      return fmt::format("speaks for {} stations; 1 to {} are possible",
                         hello.stations.size(), most_stations);
    if (!is_time_of_day(hello.epoch_unix_ms))
      return "its clock shows no time of day";
    if (hello.world != setup->world)
      return fmt::format("provider {} has another map or other services; start "
                         "both sides with the same scenario file",
                         setup->name);
    return setup->doubt(hello, nonce);
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
  return {
      [self](const peer_hello& hello, const uplink_actor& peer) {
        return self->state.take(hello, peer);
      },
      [self](tick_atom) { self->quit(); },
  };
}

struct gate_state {
  static inline const char* name = "gate";

  gate_impl::stateful_pointer<gate_state> self;
  std::shared_ptr<const gate_setup> setup;
  std::uint64_t types = fingerprint_of_types();
  std::size_t open = 0;
  std::uint64_t refused = 0;
  time_point next_complaint;

  void note_refusal(const std::string& why) {
    ++refused;
    const auto t = now(self);
    if (t < next_complaint)
      return;
    next_complaint = t + complaint_period;
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
  const auto provider = self->state.setup->provider.address();
  self->monitor(self->state.setup->provider);
  self->set_down_handler([self, provider](const caf::down_msg& down) {
    if (down.source == provider)
      self->quit(); // nobody is left to be let in to
    else
      --self->state.open;
  });
  return {
      [self](std::uint32_t protocol, std::uint64_t types)
          -> caf::result<std::uint32_t, std::uint64_t, std::string,
                         caf::strong_actor_ptr> {
        auto& state = self->state;
        const auto same = protocol == remote_protocol && types == state.types;
        if (!same || state.open >= most_entrances)
          return {remote_protocol, state.types, std::string{},
                  caf::strong_actor_ptr{}};
        auto nonce = state.setup->draw_nonce();
        const auto in =
            self->spawn(entrance, gate_impl{self}, state.setup, nonce);
        self->monitor(in);
        ++state.open;
        return {remote_protocol, state.types, std::move(nonce),
                caf::actor_cast<caf::strong_actor_ptr>(in)};
      },
      [self](tick_atom, const std::string& why) {
        if (is_from_here(self))
          self->state.note_refusal(why);
      },
  };
}

} // namespace

gate_actor spawn_gate(caf::actor_system& sys, gate_setup setup) {
  return sys.spawn(gate, std::move(setup));
}

} // namespace sofof
