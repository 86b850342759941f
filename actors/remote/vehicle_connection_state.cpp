// How long a provider is connected to vehicles on another host.
#include "actors/remote/vehicle_connection_state.hpp"

#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "network/keys/identity.hpp"

#include <fmt/format.h>

#include <utility>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

/// So long a connection outlives its provider, to pass on what it sent last.
constexpr duration last_words = 50ms;
constexpr std::size_t results_per_station = 8; // under way

} // namespace

void vehicle_connection_state::start(
    vehicle_connection_setup with,
    const messages::provider_endpoint_actor& by) {
  setup = std::move(with);
  endpoint = by;
  life.emplace(now(self),
               std::chrono::milliseconds{setup.peer_clock.epoch_unix_ms()
                                         - setup.clock.epoch_unix_ms()},
               setup.pace);
  rules.emplace(setup.stations);
  results.emplace(results_per_station * setup.stations.size(),
                  protocol::silence_limit);
  self->monitor(setup.peer);
  self->monitor(setup.provider);
  log_event(messages::event_type::peer_connected, 0, stations());
  on_tick();
}

void vehicle_connection_state::on_tick() {
  const auto t = now(self);
  if (ends_at && t >= *ends_at) {
    leave("the provider has ended");
    return;
  }
  if (life->is_lost(t)) {
    leave("silent");
    return;
  }
  if (life->is_due(t))
    send_to_peer(life->beat(t));
  send_after(self, self, protocol::ping_period, messages::tick_atom_v);
}

void vehicle_connection_state::on_down(const caf::down_msg& down) {
  const auto provider = down.source == setup.provider.address();
  if (provider && down.reason == caf::exit_reason::user_shutdown)
    ends_at = now(self) + last_words; // they are still to be passed on
  else if (provider || down.source == setup.peer.address())
    leave("gone");
}

void vehicle_connection_state::leave(std::string_view why) {
  log_event(messages::event_type::peer_lost, 0,
            fmt::format("{}: {}", stations(), why));
  self->quit(caf::exit_reason::remote_link_unreachable);
}

/// @returns e.g. "stations 101-106".
std::string vehicle_connection_state::stations() const {
  return network::describe(
      {{setup.stations.begin(), setup.stations.end()}, {}});
}

void vehicle_connection_state::log_event(messages::event_type what,
                                         station_id station,
                                         std::string_view detail) {
  send_record(self, setup.recorder,
              messages::event_record{.at = now(self),
                                     .what = what,
                                     .station = station,
                                     .detail = std::string{detail}});
}

} // namespace sofof::actors
