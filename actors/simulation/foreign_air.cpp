// An actor hears, and asks for nothing.
#include "actors/simulation/foreign_air.hpp"

#include "actors/runtime/time.hpp"

#include <caf/event_based_actor.hpp>
#include <caf/send.hpp>

#include <chrono>
#include <map>
#include <utility>
#include <variant>

namespace sofof::actors {

namespace {

/// No certificate and no station has this number.
constexpr sender_id nobody_known = sender_id::rep{1} << 62;

/// So many foreign stations are heard at once, each until it has been silent
/// for so long; no street has more.
constexpr std::size_t most_foreign_stations = 256;
constexpr duration silence = std::chrono::seconds{10};

/// Bounds what strangers can make others remember.
class station_list {
public:
  /// @returns whether there is room for it, as there is for who was heard.
  bool admits(station_id who, time_point now) {
    if (!heard_.contains(who)) {
      if (heard_.size() >= most_foreign_stations)
        std::erase_if(
            heard_, [now](const auto& x) { return now - x.second > silence; });
      if (heard_.size() >= most_foreign_stations)
        return false;
    }
    heard_[who] = now;
    return true;
  }

private:
  std::map<station_id, time_point> heard_;
};

caf::behavior foreign_ear(caf::event_based_actor* self,
                          foreign_air_setup setup) {
  return {[self, setup = std::move(setup),
           known = station_list{}](messages::its_pdu& message) mutable {
    const auto station = message.station();
    if (!station || setup.own.contains(*station)
        || is_provider_station(station->value())
        || !known.admits(*station, now(self)))
      return;
    message.sender = nobody_known;
    for (const auto& provider : setup.providers)
      self->send(provider, message, messages::requester_actor{});
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
