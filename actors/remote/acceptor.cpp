// Where processes of vehicles come in.
#include "actors/remote/acceptor.hpp"

#include "actors/remote/admissions.hpp"
#include "actors/remote/handshake.hpp"
#include "actors/remote/version_check.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

namespace sofof {

namespace {

/// So many may introduce themselves at a time; for one more the oldest goes,
/// for each process as well as for all.
constexpr std::size_t most_entrances = 256;
constexpr std::size_t most_entrances_of_one = 2;

/// A process that may introduce itself.
struct newcomer {
  caf::strong_actor_ptr in; ///< Its entrance.
  caf::node_id process;
};

struct gate_state {
  static inline const char* name = "gate";

  gate_actor::stateful_pointer<gate_state> self;
  std::shared_ptr<const gate_setup> setup;
  admissions_actor admissions;
  std::vector<newcomer> newcomers; // the oldest first

  /// @returns a number to sign, and where to do so.
  std::pair<std::string, caf::strong_actor_ptr> let_come() {
    const auto& who = self->current_sender();
    const auto process = who ? who->node() : caf::node_id{};
    std::string nonce;
    try {
      nonce = setup->draw_nonce();
    } catch (const std::exception& e) {
      self->send(admissions, std::string{e.what()});
      return {};
    }
    make_room(process);
    const auto in =
        spawn_entrance(self->system(), admissions, setup, process, nonce);
    self->monitor(in);
    self->send(admissions, in);
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

  void gone(const caf::actor_addr& who) {
    std::erase_if(newcomers, [&](const newcomer& x) { return x.in == who; });
  }
};

gate_actor::behavior_type gate(gate_actor::stateful_pointer<gate_state> self,
                               gate_setup setup) {
  auto& s = self->state;
  s.self = self;
  s.setup = std::make_shared<const gate_setup>(std::move(setup));
  s.admissions = spawn_admissions(self->system(), s.setup);
  self->link_to(s.admissions); // they end together
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.gone(down.source); });
  self->set_default_handler(caf::drop); // what no interface has
  return {
      [self](std::uint32_t protocol, std::uint64_t types) {
        return greet(protocol, types,
                     [self] { return self->state.let_come(); });
      },
  };
}

} // namespace

gate_actor spawn_gate(caf::actor_system& sys, gate_setup setup) {
  return sys.spawn(gate, std::move(setup));
}

} // namespace sofof
