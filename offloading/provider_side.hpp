// All that an edge server needs to offer services, behind one port.
#pragma once

#include "offloading/cycle_work.hpp"
#include "offloading/provider.hpp"
#include "offloading/vehicle_side.hpp"

#include <cstdint>
#include <memory>

namespace sofof::offloading {

/// What it makes others do. Nothing of this calls it back.
class provider_side_port {
public:
  virtual ~provider_side_port() = default;

  /// To be brought to a vehicle; what does not arrive is lost, no more.
  virtual void send(peer_id requester, to_vehicle message) = 0;
  /// @returns when a cycle of this session that starts now will be done, not
  /// before `start`; by default at once, as where time is real.
  virtual cycle_work finish(const messages::session_id&, time_point start,
                            std::uint64_t /*cycle*/) {
    return start;
  }
  /// Records are lost unless this is overridden.
  virtual void record(messages::record&&) {}
  /// `on_timer` is due then, with this number.
  virtual void wake_at(time_point t, std::uint64_t number) = 0;
};

/// A provider, and the functions of its sessions. A function runs from its
/// first input on; one that has none within protocol::start_timeout is given
/// up. Whoever owns it carries messages and timers.
///
/// No clock, no I/O, no threads: every call says what time it is, never less
/// than before.
class provider_side {
public:
  /// @param port  Outlives it.
  provider_side(provider_setup setup, provider_side_port& port);
  ~provider_side();

  /// A station tells where it is.
  /// @param from  Where its requester is reached.
  void on_cam(const messages::cam& c, peer_id from, time_point now);

  /// @param from  Whoever has sent it. Only its requester feeds and ends a
  ///              session; that a request comes from the station that it names
  ///              is for the owner to see to.
  void on_message(peer_id from, const to_provider& message, time_point now);

  /// A requester cannot be reached any more.
  void on_lost(peer_id requester, time_point now);

  /// The time that `wake_at` was given with this number has come.
  void on_timer(std::uint64_t number, time_point now);

  /// Ends all sessions.
  void shut_down(time_point now);

private:
  class parts;
  std::unique_ptr<parts> parts_;
};

} // namespace sofof::offloading
