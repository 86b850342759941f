// The wire between vehicles and a provider, for tests that cut it.
#pragma once

#include "actors/runtime/time.hpp"
#include "messages/type_ids.hpp"

#include <caf/event_based_actor.hpp>
#include <caf/send.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sofof::test {

/// Who speaks over a wire, and which of its ends each takes for the other.
struct connection {
  caf::actor vehicles, their_peer, provider, its_peer;
};

/// What a wire does to messages, which all its connections look at. As in
/// life nothing gets lost or overtaken as long as a connection lasts.
struct wire {
  connection latest;
  bool cut = false; ///< All waits until it is not, and neither side is told.
  /// How often a message arrives; once if nobody says otherwise.
  std::function<int(const caf::message&)> copies;
  /// How long it takes.
  std::function<duration()> delay;
  std::uint64_t carried = 0;
};

using wire_ptr = std::shared_ptr<wire>;

/// One end: what it is told comes out of the other end, in that one's name.
struct wire_end {
  static inline const char* name = "wire_end";

  caf::event_based_actor* self = nullptr;
  wire_ptr on;
  caf::strong_actor_ptr user; ///< Who is spoken to here.
  caf::actor other;
  time_point latest;               ///< When all so far has arrived there.
  std::vector<caf::message> stuck; ///< What has come here and waits.

  void carry(const caf::message& what) {
    if (!other)
      return; // nobody has been let in yet
    ++on->carried;
    latest = std::max(latest, actors::now(self)
                                  + (on->delay ? on->delay() : duration{}));
    const auto copies = on->copies ? on->copies(what) : 1;
    for (int k = 0; k < copies; ++k)
      actors::send_at(self, other, latest, messages::tick_atom_v, what);
  }

  void deliver(const caf::message& what) {
    stuck.push_back(what);
    if (on->cut || !user)
      return;
    for (const auto& x : std::exchange(stuck, {}))
      user->enqueue(self->ctrl(), caf::make_message_id(), x, self->context());
  }

  void lost() {
    if (!on->cut)
      self->send_exit(other, caf::exit_reason::remote_link_unreachable);
    self->quit(caf::exit_reason::remote_link_unreachable);
  }
};

inline caf::behavior make_wire_end(caf::stateful_actor<wire_end>* self,
                                   wire_ptr on) {
  self->state.self = self;
  self->state.on = std::move(on);
  self->set_default_handler([self](caf::scheduled_actor*, caf::message& what) {
    self->state.carry(what);
    return caf::skippable_result{caf::message{}};
  });
  self->set_down_handler([self](const caf::down_msg&) { self->state.lost(); });
  return {
      [self](messages::tick_atom, const caf::message& what) {
        self->state.deliver(what);
      },
      [self](messages::tick_atom, const caf::strong_actor_ptr& user,
             const caf::actor& other) {
        self->state.user = user;
        self->state.other = other;
        self->monitor(user);
      },
  };
}

/// A handshake that puts a wire between those who meet there.
inline messages::handshake_actor::behavior_type
wired_handshake(messages::handshake_actor::pointer self,
                messages::handshake_actor in, wire_ptr on) {
  return {[=](const messages::peer_hello& hello,
              const messages::vehicle_endpoint_actor& vehicles)
              -> caf::result<messages::peer_welcome,
                             messages::provider_endpoint_actor> {
    auto promise =
        self->make_response_promise<messages::peer_welcome,
                                    messages::provider_endpoint_actor>();
    const auto there = self->system().spawn(make_wire_end, on);
    const auto here = self->system().spawn(make_wire_end, on);
    self->request(in, caf::infinite, hello,
                  caf::actor_cast<messages::vehicle_endpoint_actor>(there))
        .then(
            [=](const messages::peer_welcome& welcome,
                const messages::provider_endpoint_actor& provider) mutable {
              caf::anon_send(here, messages::tick_atom_v,
                             caf::actor_cast<caf::strong_actor_ptr>(vehicles),
                             there);
              caf::anon_send(there, messages::tick_atom_v,
                             caf::actor_cast<caf::strong_actor_ptr>(provider),
                             here);
              on->latest = {caf::actor_cast<caf::actor>(vehicles), here,
                            caf::actor_cast<caf::actor>(provider), there};
              promise.deliver(
                  welcome,
                  caf::actor_cast<messages::provider_endpoint_actor>(here));
              self->quit();
            },
            [=](caf::error& error) mutable {
              self->send_exit(here, caf::exit_reason::user_shutdown);
              self->send_exit(there, caf::exit_reason::user_shutdown);
              promise.deliver(std::move(error));
              self->quit();
            });
    return promise;
  }};
}

/// An acceptor whose handshakes do so.
inline messages::acceptor_actor::behavior_type
wired_acceptor(messages::acceptor_actor::pointer self,
               messages::acceptor_actor acceptor, wire_ptr on) {
  return {[=](std::uint32_t protocol, std::uint64_t types)
              -> caf::result<std::uint32_t, std::uint64_t, std::string,
                             caf::strong_actor_ptr> {
    auto promise =
        self->make_response_promise<std::uint32_t, std::uint64_t, std::string,
                                    caf::strong_actor_ptr>();
    self->request(acceptor, caf::infinite, protocol, types)
        .then(
            [=](std::uint32_t p, std::uint64_t t, const std::string& nonce,
                const caf::strong_actor_ptr& in) mutable {
              caf::strong_actor_ptr wired;
              if (in)
                wired = caf::actor_cast<caf::strong_actor_ptr>(self->spawn(
                    wired_handshake,
                    caf::actor_cast<messages::handshake_actor>(in), on));
              promise.deliver(p, t, nonce, wired);
            },
            [=](caf::error& error) mutable {
              promise.deliver(std::move(error));
            });
    return promise;
  }};
}

} // namespace sofof::test
