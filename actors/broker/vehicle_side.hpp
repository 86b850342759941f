// Providers that vehicles reach over a broker.
#pragma once

#include "actors/broker/wire.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace sofof::actors {

/// How a process of vehicles uses a broker. Functions are called from any
/// thread.
struct vehicle_side_setup {
  station_id station = 0; ///< One of its own, which speaks for all.
  std::string user;       ///< As whom it sends.
  /// @returns whether an envelope of this user is this provider's. Empty: all
  /// are.
  std::function<bool(const std::string& user, const std::string& provider)>
      is_sent_by{};
  std::function<void(const wire::envelope&)> send;
  std::function<std::int64_t()> draw_link; ///< Numbers that nobody else has.
};

/// Stands for providers: the acceptor, handshake and endpoint that a
/// provider_connection speaks to are one actor here, which sends envelopes.
/// What a provider_connection sends all the time is acknowledged as soon as it
/// is with the broker's client; a CAM or CPM that several providers should get
/// is sent once.
class vehicle_side {
public:
  vehicle_side(caf::actor_system& sys, vehicle_side_setup setup);

  /// @returns a new proxy of the provider of this name. It ends with whoever
  /// asks it first, and with `lose`.
  messages::acceptor_actor proxy_for(const std::string& provider) const;

  /// Tells everybody what a station of this process has to say; once, whoever
  /// else has it sent.
  void tell(station_id from, const messages::its_pdu& message) const;

  /// An envelope has come.
  void on_envelope(const wire::envelope& x) const;

  /// The broker is lost: all proxies end.
  void lose() const;

  struct shared; ///< Of all proxies.

private:
  std::shared_ptr<shared> shared_;
};

} // namespace sofof::actors
