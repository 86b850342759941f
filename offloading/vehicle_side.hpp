// All that a vehicle needs to offload services, behind one port.
#pragma once

#include "offloading/cycle_work.hpp"
#include "offloading/requester.hpp"
#include "offloading/source_selector.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <variant>
#include <vector>

namespace sofof::offloading {

/// What crosses the air to a provider, besides the vehicle's CAMs.
using to_provider =
    std::variant<messages::service_request, messages::service_input,
                 messages::service_end>;

/// What comes back.
using to_vehicle =
    std::variant<messages::service_offer, messages::service_response,
                 messages::session_digest, messages::service_result,
                 messages::service_end>;

/// What the offloading side of a vehicle is made of.
struct vehicle_side_setup : requester_setup {
  bool record_margins = false; ///< Of results that are used.
};

/// What it makes others do. Nothing of this calls it back.
class vehicle_port {
public:
  virtual ~vehicle_port() = default;

  /// To be brought to a provider; what does not arrive is lost, no more.
  virtual void send(peer_id provider, to_provider message) = 0;
  /// The vehicle goes by this result from now on.
  virtual void use(const messages::service_result& result) = 0;
  /// The results of a service come from providers now, or from its own function
  /// again.
  virtual void on_source(const messages::service_name& service,
                         bool remote) = 0;
  /// @returns when a cycle of the vehicle's own function that starts now will
  /// be done, not before `start`; by default at once, as where time is real.
  virtual cycle_work finish(const messages::service_name&, time_point start,
                            std::uint64_t /*cycle*/) {
    return start;
  }
  /// Records are lost unless this is overridden.
  virtual void record(messages::record&&) {}
  /// `on_timer` is due then, with this number.
  virtual void wake_at(time_point t, std::uint64_t number) = 0;
};

/// A requester, and for each service a source selector, a watchdog and the
/// vehicle's own function. The requester calls the selectors, these their
/// watchdogs and functions; what those find goes up when a call is done, before
/// it returns. Whoever owns it carries messages and timers, tells it where the
/// vehicle is (every protocol::ego_period) and what its services work on, and
/// broadcasts CAMs, by which providers find it.
///
/// No clock, no I/O, no threads: every call says what time it is, never less
/// than before.
class vehicle_side {
public:
  /// @param port  Outlives it.
  vehicle_side(vehicle_side_setup setup, vehicle_port& port, time_point now);
  ~vehicle_side();

  void on_motion(const messages::ego_state& ego);

  /// New input of a service; of one that is not known it is ignored.
  void on_input(const messages::service_name& service,
                const messages::service_input& input, time_point now);

  /// @param from  Whoever has sent it; what it says in the name of a provider
  ///              that another peer speaks for is ignored.
  void on_message(peer_id from, const to_vehicle& message, time_point now);

  /// A provider cannot be reached any more.
  void on_lost(peer_id provider, time_point now);

  /// The time that `wake_at` was given with this number has come.
  void on_timer(std::uint64_t number, time_point now);

  /// Ends all sessions.
  void shut_down(time_point now);

private:
  class parts;
  std::unique_ptr<parts> parts_;
};

} // namespace sofof::offloading
