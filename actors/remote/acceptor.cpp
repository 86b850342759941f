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

namespace sofof::actors {

namespace {

/// So many may introduce themselves at a time; for one more the oldest goes,
/// for each process as well as for all.
constexpr std::size_t most_handshakes = 256;
constexpr std::size_t most_handshakes_of_one = 2;

/// A process; several that come by a broker are actors of this one.
struct asking_process {
  caf::node_id node;
  caf::actor_id actor = 0; ///< Of this process; 0 for other nodes.

  bool operator==(const asking_process&) const = default;
};

/// A process that may introduce itself.
struct pending_peer {
  caf::strong_actor_ptr in; ///< Its handshake.
  asking_process process;
};

struct acceptor_state {
  static inline const char* name = "acceptor";

  messages::acceptor_actor::stateful_pointer<acceptor_state> self;
  std::shared_ptr<const acceptor_setup> setup;
  admissions_actor admissions;
  std::vector<pending_peer> pending; // the oldest first

  /// @returns a number to sign, and where to do so.
  std::pair<std::string, caf::strong_actor_ptr> begin_handshake() {
    const auto& who = self->current_sender();
    const auto node = who ? who->node() : caf::node_id{};
    const asking_process process{node, node == self->node() ? who->id() : 0};
    std::string nonce;
    try {
      nonce = setup->draw_nonce();
    } catch (const std::exception& e) {
      self->send(admissions, std::string{e.what()});
      return {};
    }
    make_room(process);
    const auto in =
        spawn_handshake(self->system(), admissions, setup, node, nonce);
    self->monitor(in);
    self->send(admissions, in);
    pending.push_back({caf::actor_cast<caf::strong_actor_ptr>(in), process});
    return {std::move(nonce), pending.back().in};
  }

  void make_room(const asking_process& process) {
    const auto same =
        std::ranges::count(pending, process, &pending_peer::process);
    if (static_cast<std::size_t>(same) >= most_handshakes_of_one)
      dismiss(std::ranges::find(pending, process, &pending_peer::process));
    else if (pending.size() >= most_handshakes)
      dismiss(pending.begin());
  }

  void dismiss(std::vector<pending_peer>::iterator at) {
    self->send_exit(caf::actor_cast<caf::actor>(at->in),
                    caf::exit_reason::user_shutdown);
    pending.erase(at);
  }

  void on_down(const caf::actor_addr& who) {
    std::erase_if(pending, [&](const pending_peer& x) { return x.in == who; });
  }
};

messages::acceptor_actor::behavior_type
acceptor(messages::acceptor_actor::stateful_pointer<acceptor_state> self,
         acceptor_setup setup) {
  auto& s = self->state;
  s.self = self;
  s.setup = std::make_shared<const acceptor_setup>(std::move(setup));
  s.admissions = spawn_admissions(self->system(), s.setup);
  self->link_to(s.admissions); // they end together
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.on_down(down.source); });
  self->set_default_handler(caf::drop); // what no interface has
  return {
      [self](std::uint32_t protocol, std::uint64_t types) {
        return check_version(protocol, types,
                             [self] { return self->state.begin_handshake(); });
      },
  };
}

} // namespace

messages::acceptor_actor spawn_acceptor(caf::actor_system& sys,
                                        acceptor_setup setup) {
  return sys.spawn(acceptor, std::move(setup));
}

} // namespace sofof::actors
