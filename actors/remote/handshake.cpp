// Where one peer introduces itself.
#include "actors/remote/handshake.hpp"

#include "actors/runtime/time.hpp"
#include "base/protocol.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <fmt/format.h>

#include <optional>
#include <utility>

namespace sofof::actors {

/// For how many stations a peer can speak.
constexpr std::size_t most_claims = 10'000;

struct handshake_state {
  static inline const char* name = "handshake";

  messages::handshake_actor::stateful_pointer<handshake_state> self = nullptr;
  admissions_actor admissions;
  std::shared_ptr<const acceptor_setup> setup;
  caf::node_id process;
  std::string nonce;
  bool is_used = false;

  // The admissions live long, and do not forget by themselves who watched them.
  ~handshake_state() {
    if (self)
      self->demonitor(admissions);
  }

  caf::result<messages::peer_welcome, messages::provider_endpoint_actor>
  on_hello(const messages::peer_hello& hello,
           const messages::vehicle_endpoint_actor& peer) {
    // Actor ids can be guessed: another process must not use it up.
    const auto& sender = self->current_sender();
    if (!sender || sender->node() != process)
      return caf::make_error(caf::sec::invalid_argument, "it was not invited");
    const auto found = look_at(hello, peer);
    if (found.refusal) {
      if (!is_used)
        self->quit(); // a peer that fails begins anew
      self->send(admissions, *found.refusal);
      return caf::make_error(caf::sec::invalid_argument, *found.refusal);
    }
    is_used = true;
    auto promise =
        self->make_response_promise<messages::peer_welcome,
                                    messages::provider_endpoint_actor>();
    self->request(admissions, caf::infinite,
                  messages::admission{{hello, peer, found.name}})
        .then(
            [this, promise](
                const messages::peer_welcome& welcome,
                const messages::provider_endpoint_actor& endpoint) mutable {
              promise.deliver(welcome, endpoint);
              self->quit();
            },
            [this, promise](caf::error& error) mutable {
              promise.deliver(std::move(error));
              self->quit();
            });
    return promise;
  }

  peer_finding look_at(const messages::peer_hello& hello,
                       const messages::vehicle_endpoint_actor& peer) const {
    if (const auto why = objection(hello, peer))
      return {{}, why};
    return setup->examine(hello, nonce, process);
  }

  std::optional<std::string>
  objection(const messages::peer_hello& hello,
            const messages::vehicle_endpoint_actor& peer) const {
    if (is_used)
      return "introduces itself twice";
    // It must not let an endpoint of ours speak to our own actors.
    if (!peer || peer.node() != process)
      return "it has no end of its own";
    if (hello.provider != setup->name)
      return fmt::format("it is provider {}", setup->name);
    if (hello.stations.empty() || hello.stations.size() > most_claims)
      return fmt::format("speaks for {} stations; 1 to {} are possible",
                         hello.stations.size(), most_claims);
    if (!messages::is_time_of_day(hello.epoch_unix_ms))
      return "its clock shows no time of day";
    if (hello.world != setup->world)
      return fmt::format("provider {} has another map or other services; start "
                         "both sides with the same scenario file, or both with "
                         "--own-map",
                         setup->name);
    return std::nullopt;
  }
};

namespace {

messages::handshake_actor::behavior_type
handshake(messages::handshake_actor::stateful_pointer<handshake_state> self,
          const admissions_actor& admissions,
          std::shared_ptr<const acceptor_setup> setup, caf::node_id process,
          std::string nonce) {
  auto& s = self->state;
  s.self = self;
  s.admissions = admissions;
  s.setup = std::move(setup);
  s.process = std::move(process);
  s.nonce = std::move(nonce);
  // It dies with the admissions, but they do not with it.
  self->monitor(admissions);
  self->set_down_handler([self](const caf::down_msg&) { self->quit(); });
  self->set_default_handler(caf::drop); // what no interface has
  return {
      [self](const messages::peer_hello& hello,
             const messages::vehicle_endpoint_actor& peer) {
        return self->state.on_hello(hello, peer);
      },
  };
}

} // namespace

messages::handshake_actor
spawn_handshake(caf::actor_system& sys, const admissions_actor& admissions,
                std::shared_ptr<const acceptor_setup> setup,
                caf::node_id process, std::string nonce) {
  return sys.spawn(handshake, admissions, std::move(setup), std::move(process),
                   std::move(nonce));
}

} // namespace sofof::actors
