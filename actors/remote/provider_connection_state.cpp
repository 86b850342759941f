// How vehicles connect to a provider on another host, and do so again when the
// connection is lost.
#include "actors/remote/provider_connection_state.hpp"

#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "base/protocol.hpp"

#include <caf/event_based_actor.hpp>
#include <fmt/format.h>

#include <utility>

namespace sofof::actors {

namespace {

/// A refusal later than this is news.
constexpr duration beginning = std::chrono::seconds{5};

} // namespace

void provider_connection_state::start(provider_connection_setup with) {
  setup = std::make_shared<const provider_connection_setup>(std::move(with));
  attempts.emplace(setup->noise, protocol::handshake_timeout);
  traffic.emplace(setup->stations);
  began = now(self);
  attempts->pause(began);
  on_tick();
}

void provider_connection_state::on_tick() {
  const auto t = now(self);
  if (peer && life->is_lost(t))
    disconnect(fmt::format("it has answered nothing for {} s",
                           to_seconds(setup->pace.silence_limit)));
  else if (peer && life->is_due(t))
    send_to_provider(life->beat(t));
  else if (!peer && attempts->is_due(t))
    attempt();
  send_after(self, self, protocol::ping_period, messages::tick_atom_v);
}

void provider_connection_state::attempt() {
  attempts->begin(now(self));
  auto helper = [connect = setup->connect,
                 owner = provider_connection_impl{self}] {
    const auto found = connect();
    if (const auto* acceptor = std::get_if<messages::acceptor_actor>(&found))
      caf::send_as(owner, owner, messages::tick_atom_v, *acceptor);
    else
      caf::send_as(owner, owner, messages::tick_atom_v,
                   std::get<std::string>(found));
  };
  if (setup->aside)
    setup->aside(std::move(helper));
  else
    self->system().spawn<caf::detached>(
        [helper = std::move(helper)](caf::event_based_actor*) { helper(); });
}

void provider_connection_state::on_attempt_failed(const std::string& why) {
  if (endpoint)
    return; // another attempt was faster
  attempts->end();
  publish(fmt::format("no connection to provider {} at {}: {}; trying again",
                      setup->provider, setup->address(), why));
}

void provider_connection_state::on_acceptor(
    const messages::acceptor_actor& found) {
  if (!endpoint) // else another attempt was faster
    endpoint = spawn_vehicle_endpoint(
        self->system(), found, setup,
        vehicle_endpoint_owner{provider_connection_impl{self}});
}

// A vehicle goes on driving, even if nobody will ever plan for it; only who has
// just begun would rather know.
void provider_connection_state::on_refusal(const std::string& why,
                                           bool for_ever) {
  endpoint = nullptr;
  attempts->end();
  if (!for_ever) {
    on_attempt_failed(why);
    return;
  }
  const auto sentence = fmt::format("provider {} at {} refuses: {}",
                                    setup->provider, setup->address(), why);
  if (was_connected || now(self) - began > beginning)
    publish(sentence);
  else
    setup->on_refusal(sentence);
}

void provider_connection_state::on_welcome(
    const messages::peer_welcome& welcome,
    const messages::provider_endpoint_actor& with) {
  attempts->end();
  was_connected = true;
  setup->on_connected();
  peer = with;
  const auto t = now(self);
  life.emplace(t,
               std::chrono::milliseconds{welcome.epoch_unix_ms
                                         - setup->clock.epoch_unix_ms()},
               setup->pace);
  self->monitor(peer);
  send_to_provider(life->beat(t));
  provider = welcome.provider;
  log_event(messages::event_type::provider_connected, setup->address());
  publish(fmt::format("connected to provider {} at {}", setup->provider,
                      setup->address()));
}

void provider_connection_state::disconnect(std::string_view why) {
  self->demonitor(peer);
  peer = nullptr;
  self->send_exit(endpoint, caf::exit_reason::user_shutdown);
  endpoint = nullptr;
  life.reset();
  traffic->close();
  setup->hang_up();
  attempts->pause(now(self));
  for (const auto& x : running)
    send_to_vehicle(x.station,
                    messages::service_end{x, messages::end_reason::peer_lost,
                                          messages::side::provider});
  running.clear();
  log_event(messages::event_type::provider_lost, why);
  publish(fmt::format("lost provider {} at {}: {}; vehicles plan for "
                      "themselves",
                      setup->provider, setup->address(), why));
}

void provider_connection_state::on_down(const caf::actor_addr& who) {
  if (peer && peer.address() == who)
    disconnect("the connection is gone");
}

bool provider_connection_state::is_from_connection() {
  return endpoint
         && self->current_sender()
                == caf::actor_cast<caf::strong_actor_ptr>(endpoint);
}

void provider_connection_state::publish(const std::string& sentence) {
  if (news.passes(sentence, now(self)))
    setup->on_news(sentence);
}

void provider_connection_state::log_event(messages::event_type what,
                                          std::string_view detail) {
  send_record(self, setup->recorder,
              messages::event_record{.at = now(self),
                                     .what = what,
                                     .provider = provider,
                                     .detail = std::string{detail}});
}

} // namespace sofof::actors
