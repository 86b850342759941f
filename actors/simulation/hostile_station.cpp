// A station that sends providers what no honest one would.
#include "actors/simulation/hostile_station.hpp"

#include "actors/runtime/time.hpp"
#include "messages/interfaces.hpp"
#include "messages/v2x/cam_content.hpp"
#include "messages/v2x/encoded.hpp"

#include <caf/event_based_actor.hpp>
#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

/// Its certificate, and the first of the stations that it makes up.
constexpr sender_id certificate = sender_id::rep{1} << 63 | 5;
constexpr station_id::rep first_station = 700'000'000;
constexpr std::size_t cars = 5, longest_octets = 300;

/// Whom providers can answer; it does not listen.
messages::requester_actor::behavior_type
ear(messages::requester_actor::pointer) {
  return {
      [](const messages::service_result&) {},
      [](const messages::service_offer&) {},
      [](const messages::session_digest&) {},
      [](const messages::service_response&,
         const std::vector<messages::provider_manager_actor>&) {},
      [](const messages::service_end&) {},
  };
}

struct hostile_state {
  static inline const char* name = "hostile_station";

  caf::event_based_actor* self = nullptr;
  std::optional<hostile_setup> setup;
  messages::requester_actor ear;
  std::size_t alive = 0; // providers
  std::uint64_t turn = 0;

  void start() {
    ear = self->spawn<caf::linked>(actors::ear);
    alive = setup->providers.size();
    for (const auto& provider : setup->providers)
      self->monitor(provider);
    send_after(self, self, setup->every, messages::tick_atom_v);
  }

  void on_tick() {
    for (const auto& provider : setup->providers) {
      auto message = made_up(setup->noise.part(++turn));
      message.sender = certificate;
      self->send(provider, std::move(message), ear);
      ++*setup->said;
    }
    send_after(self, self, setup->every, messages::tick_atom_v);
  }

  messages::its_pdu made_up(const random_stream& of) const {
    enum : std::uint32_t { what, length, where };
    const auto kind = of.uniform(0, what);
    if (kind < 0.25)
      return {octets(of, of.uniform(0, length))};
    auto message =
        messages::encoded(messages::make_cam(car(of), {}, *setup->where));
    if (kind < 0.5) // a bit of it is changed
      message.octets.at(at(of.uniform(0, where), message.octets.size())) ^=
          std::byte{1} << (of.bits(0, where) % 8);
    else if (kind < 0.6) // its end is cut off
      message.octets.resize(at(of.uniform(0, where), message.octets.size()));
    return message;
  }

  static std::size_t at(double share, std::size_t size) {
    return static_cast<std::size_t>(share * static_cast<double>(size));
  }

  static std::vector<std::byte> octets(const random_stream& of, double share) {
    std::vector<std::byte> all(at(share, longest_octets));
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k] = static_cast<std::byte>(of.bits(k, 9) & 0xff);
    return all;
  }

  messages::cam car(const random_stream& of) const {
    enum : std::uint32_t { which = 20, x, y, heading, speed };
    messages::cam c;
    c.station = static_cast<station_id::rep>(first_station
                                             + at(of.uniform(0, which), cars));
    c.at = now(self);
    c.position = {of.uniform(setup->from_m.x_m, setup->to_m.x_m, 0, x),
                  of.uniform(setup->from_m.y_m, setup->to_m.y_m, 0, y)};
    c.heading_rad = of.uniform(-std::numbers::pi, std::numbers::pi, 0, heading);
    c.speed_mps = of.uniform(0, 20, 0, speed);
    return c;
  }
};

caf::behavior hostile_station(caf::stateful_actor<hostile_state>* self,
                              hostile_setup setup) {
  assert(setup.every > duration{} && !setup.providers.empty());
  self->state.self = self;
  self->state.setup.emplace(std::move(setup));
  self->state.start();
  self->set_down_handler([self](const caf::down_msg&) {
    if (--self->state.alive == 0)
      self->quit(caf::exit_reason::user_shutdown);
  });
  return {[self](messages::tick_atom) { self->state.on_tick(); }};
}

} // namespace

void spawn_hostile_station(caf::actor_system& sys, hostile_setup setup) {
  sys.spawn(hostile_station, std::move(setup));
}

} // namespace sofof::actors
