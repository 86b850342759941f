// The air between vehicles.
#include "actors/simulation/air.hpp"

#include "actors/runtime/time.hpp"
#include "base/geometry.hpp"
#include "channel/link_direction.hpp"
#include "messages/v2x/octets_on_air.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <map>
#include <utility>

namespace sofof::actors {

namespace {

struct air_state {
  static inline const char* name = "air";

  struct ear {
    messages::air_listener_actor listener;
    point at;
  };

  messages::air_actor::pointer self = nullptr;
  air_setup setup;
  std::map<station_id::rep, ear> ears;
  std::map<std::pair<station_id::rep, station_id::rep>, channel::link_direction>
      ways; // from, to

  void on_place(station_id::rep who, point at,
                const messages::air_listener_actor& listener) {
    auto& own = ears[who];
    own.at = at;
    if (own.listener == listener)
      return;
    own.listener = listener;
    self->monitor(listener);
  }

  channel::link_direction& way(station_id::rep from, station_id::rep to) {
    auto known = ways.find({from, to});
    if (known == ways.end()) {
      const channel::channel_draws draws{setup.channel, setup.noise, from, to};
      known = ways.emplace(std::pair{from, to},
                           channel::link_direction{
                               draws, channel::direction::up, nullptr})
                  .first;
    }
    return known->second;
  }

  void on_word(station_id::rep from, point at, const messages::its_pdu& what) {
    const auto sent = now(self);
    const auto is_foreign = !ears.contains(from);
    if (!is_foreign && setup.tell_others)
      setup.tell_others(what);
    const auto number =
        static_cast<std::uint64_t>(sent.time_since_epoch().count());
    for (const auto& [who, ear] : ears) {
      if (who == from || distance_m(at, ear.at) > setup.range_m)
        continue;
      if (is_foreign) { // it has come by a wire of its own
        self->send(ear.listener, at, what);
        continue;
      }
      const auto arrives = way(from, who).arrival(
          sent, channel::message_class::other, number, octets_on_air(what));
      if (arrives)
        send_at(self, ear.listener, *arrives, at, what);
    }
  }

  void on_down(const caf::actor_addr& who) {
    std::erase_if(ears, [&](const auto& x) {
      if (x.second.listener.address() != who)
        return false;
      std::erase_if(ways, [&](const auto& w) {
        return w.first.first == x.first || w.first.second == x.first;
      });
      return true;
    });
  }
};

messages::air_actor::behavior_type
air(messages::air_actor::stateful_pointer<air_state> self, air_setup setup) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  self->set_down_handler(
      [self](const caf::down_msg& down) { self->state.on_down(down.source); });
  return {
      [self](station_id::rep who, point at,
             const messages::air_listener_actor& listener) {
        self->state.on_place(who, at, listener);
      },
      [self](station_id::rep from, point at, const messages::its_pdu& what) {
        self->state.on_word(from, at, what);
      },
  };
}

} // namespace

messages::air_actor spawn_air(caf::actor_system& sys, air_setup setup) {
  return sys.spawn(air, std::move(setup));
}

} // namespace sofof::actors
