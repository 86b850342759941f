// Vehicles that a provider reaches over a broker.
#pragma once

#include "actors/broker/wire.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <functional>
#include <memory>
#include <string>

namespace sofof::actors {

/// How a provider uses a broker. Functions are called from any thread.
struct provider_side_setup {
  messages::acceptor_actor acceptor;
  std::string name;       ///< Of the provider.
  station_id station = 0; ///< Its own.
  std::string user;       ///< As whom it sends.
  std::function<void(const wire::envelope&)> send;
  /// Hears ITS messages for everybody of stations that no process has
  /// introduced.
  std::function<void(messages::its_pdu)> on_foreign = [](auto&&) {};
};

/// Stands for processes of vehicles: each that asks is an actor here, which
/// introduces itself at the acceptor as a peer on another host does, and sends
/// envelopes. An envelope is a process's own if it is for a station that it was
/// let in with. What an endpoint sends all the time is acknowledged as soon as
/// it is with the broker's client.
class provider_side {
public:
  provider_side(caf::actor_system& sys, provider_side_setup setup);

  /// An envelope has come.
  void on_envelope(const wire::envelope& x) const;

  /// The broker is lost: all processes are.
  void lose() const;

  struct shared; ///< Of all processes.

private:
  std::shared_ptr<shared> shared_;
};

} // namespace sofof::actors
