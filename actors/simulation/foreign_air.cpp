// One actor hears, and one is whom providers would serve.
#include "actors/simulation/foreign_air.hpp"

#include "actors/runtime/time.hpp"

#include <caf/event_based_actor.hpp>
#include <caf/send.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <utility>
#include <variant>

namespace sofof::actors {

namespace {

/// No certificate and no station has this number.
constexpr sender_id nobody_known = sender_id::rep{1} << 62;

/// It wants no service.
messages::requester_actor::behavior_type
foreign_requester(messages::requester_actor::pointer) {
  return {[](const messages::service_result&) {},
          [](const messages::service_offer&) {},
          [](const messages::service_response&,
             const std::vector<messages::provider_manager_actor>&) {},
          [](const messages::session_digest&) {},
          [](const messages::service_end&) {}};
}

caf::behavior foreign_ear(caf::event_based_actor* self,
                          foreign_air_setup setup) {
  const auto nobody = self->spawn<caf::linked>(foreign_requester);
  return {[=, setup = std::move(setup)](messages::its_pdu& message) {
    const auto station = message.station();
    if (!station || setup.own.contains(*station)
        || is_provider_station(station->value()))
      return;
    message.sender = nobody_known;
    for (const auto& provider : setup.providers)
      self->send(provider, message, nobody);
    const auto word = setup.decode(message, now(self));
    if (const auto* x = std::get_if<messages::decoded_mcm>(&word);
        x && setup.air) // the only words that vehicles hear
      self->send(setup.air, station->value(), x->reference, message);
  }};
}

} // namespace

foreign_air::foreign_air(caf::actor_system& sys, foreign_air_setup setup)
    : ear_{sys.spawn(foreign_ear, std::move(setup))} {}

foreign_air::~foreign_air() {
  caf::anon_send_exit(ear_, caf::exit_reason::user_shutdown);
}

void foreign_air::on_message(messages::its_pdu message) const {
  caf::anon_send(ear_, std::move(message));
}

} // namespace sofof::actors
