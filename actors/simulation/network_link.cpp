// The air between one vehicle and one provider.
#include "actors/simulation/network_link.hpp"

#include "actors/runtime/time.hpp"
#include "actors/simulation/on_air.hpp"
#include "messages/v2x/octets_on_air.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <concepts>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

struct link_state {
  static inline const char* name = "network_link";

  messages::link_actor::pointer self = nullptr;
  messages::provider_actor far;
  messages::requester_actor near;
  std::optional<link_setup> setup;
  // Who feeds the sessions at the far end.
  std::vector<std::pair<messages::session_id, messages::provider_manager_actor>>
      managers;
  std::uint64_t carried = 0;

  template <class Receiver, class Message, class... Ts>
  void up(const Receiver& receiver, const Message& message, Ts&&... xs) {
    carry(setup->up, channel::message_class::other, time_number(message),
          receiver, message, std::forward<Ts>(xs)...);
  }

  template <class Message, class... Ts>
  void down(const Message& message, Ts&&... xs) {
    constexpr auto kind = std::same_as<Message, messages::session_digest>
                              ? channel::message_class::digest
                              : channel::message_class::other;
    if (near)
      carry(setup->down, kind, time_number(message), near, message,
            std::forward<Ts>(xs)...);
  }

  // They are numbered by the time they are sent at, so that the noise of one
  // does not depend on how many went before.
  std::uint64_t time_number(const auto&) const {
    return static_cast<std::uint64_t>(now(self).time_since_epoch().count());
  }
  // Those that are sent together do not share their noise.
  std::uint64_t time_number(const messages::its_pdu& message) const {
    constexpr std::size_t id = 1; // the octet of the message's id
    const auto of_its_kind =
        message.octets.size() > id
            ? std::to_integer<std::uint64_t>(message.octets[id])
            : 0;
    return time_number(0) ^ of_its_kind << 56;
  }

  template <class Receiver, class Message, class... Ts>
  void carry(link_way& on, channel::message_class kind, std::uint64_t number,
             const Receiver& receiver, const Message& message, Ts&&... xs) {
    const auto sent = now(self);
    const auto octets = octets_on_air(message);
    const auto through =
        on.air.carry(sent, kind, number, octets,
                     setup->place ? setup->place->last() : std::nullopt);
    const auto fate = through.arrives && setup->faults
                          ? setup->faults->of(carried++)
                          : channel::link_faults::fate{};
    channel::sending leaving{
        purpose_of(message), setup->station,      octets, sent,
        through.by,          through.is_overtaken};
    if (!through.arrives || fate.lost) {
      if (fate.lost)
        leaving.by = channel::disturbance::loss;
      if (on.octets)
        on.octets->lose(leaving);
      return;
    }
    const auto deliver = [&](time_point arrives) {
      if (on.octets)
        on.octets->send(leaving, arrives);
      const auto wait = through.wait;
      send_at(self, receiver, arrives,
              after(message, {wait, arrives - sent - wait}), xs...);
    };
    deliver(*through.arrives + fate.extra_delay);
    leaving = leaving.copy();
    if (through.copy_arrives)
      deliver(*through.copy_arrives);
    if (fate.copy_after)
      deliver(*through.arrives + *fate.copy_after);
  }

  void meet(const messages::requester_actor& requester) {
    if (requester == near)
      return;
    if (near)
      self->demonitor(near);
    near = requester;
    self->monitor(near);
  }

  void on_response(const messages::service_response& response,
                   const std::vector<messages::provider_manager_actor>& given) {
    auto manager = given.begin();
    for (const auto& v : response.verdicts)
      if (v.accepted && manager != given.end())
        managers.emplace_back(v.session, *manager++);
    const std::vector<messages::provider_manager_actor> me(
        given.size(),
        messages::provider_manager_actor{messages::link_actor{self}});
    down(response, me);
  }

  void on_input(const messages::service_input& input) {
    auto i = std::ranges::find(managers, input.session,
                               &decltype(managers)::value_type::first);
    if (i != managers.end())
      up(i->second, input);
  }

  void on_result(const messages::service_result& result) {
    if (near)
      carry(setup->down, channel::message_class::result, result.cycle, near,
            result);
  }

  void on_end(const messages::service_end& end) {
    std::erase_if(managers,
                  [&](const auto& m) { return m.first == end.session; });
    if (end.from == messages::side::provider)
      down(end);
    else
      up(far, end);
  }
};

messages::link_actor::behavior_type
link(messages::link_actor::stateful_pointer<link_state> self,
     messages::provider_actor far, link_setup setup) {
  auto& state = self->state;
  state.self = self;
  state.far = std::move(far);
  state.setup.emplace(std::move(setup));
  state.setup->up.air.begin(state.setup->run_begins);
  state.setup->down.air.begin(state.setup->run_begins);
  self->monitor(state.far);
  self->set_down_handler([self](const caf::down_msg& down) {
    self->quit(down.reason ? down.reason : caf::exit_reason::user_shutdown);
  });
  return {
      [self](const messages::its_pdu& message,
             const messages::requester_actor& requester) {
        self->state.meet(requester);
        self->state.up(self->state.far, message,
                       messages::requester_actor{messages::link_actor{self}});
      },
      [self](const messages::service_request& request,
             const messages::requester_actor& requester) {
        self->state.meet(requester);
        self->state.up(self->state.far, request,
                       messages::requester_actor{messages::link_actor{self}});
      },
      [self](const messages::service_end& end) { self->state.on_end(end); },
      [self](const messages::service_result& result) {
        self->state.on_result(result);
      },
      [self](const messages::service_offer& offer) { self->state.down(offer); },
      [self](const messages::session_digest& digest) {
        self->state.down(digest);
      },
      [self](const messages::service_response& response,
             const std::vector<messages::provider_manager_actor>& managers) {
        self->state.on_response(response, managers);
      },
      [self](const messages::service_input& input) {
        self->state.on_input(input);
      },
  };
}

} // namespace

messages::link_actor spawn_network_link(caf::actor_system& sys,
                                        messages::provider_actor far,
                                        link_setup setup) {
  return sys.spawn(link, std::move(far), std::move(setup));
}

} // namespace sofof::actors
