// The time that a run lives in: virtual or wall clock, around one CAF system.
#pragma once

#include "actors/remote/connection_filter.hpp"
#include "actors/runtime/clock_error.hpp"
#include "base/job_pool.hpp"
#include "base/time.hpp"
#include "messages/etsi/its_time.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor.hpp>
#include <caf/actor_system.hpp>
#include <caf/node_id.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sofof::scenario {

/// Owns an actor system and moves its time. Call everything from one thread.
class runtime {
public:
  virtual ~runtime() = default;

  virtual caf::actor_system& system() = 0;

  /// @returns the time of the run now.
  virtual time_point now() const = 0;

  /// @returns the time of day of the run's time.
  virtual messages::etsi::its_clock clock() const = 0;

  /// Returns when it is `end`: virtual time gets there as fast as it can.
  virtual void run_until(time_point end) = 0;

  /// Returns when these actors, which were sent exits, have ended.
  virtual void await_end(const std::vector<caf::actor>& leaving) = 0;
};

/// A wall-clock runtime that talks to other processes.
class network_runtime : public runtime {
public:
  /// Filters what comes from other processes; before anything is published or
  /// connected.
  virtual void filter(actors::filter_setup setup) = 0;

  /// @returns whom TLS has established behind a process that is connected;
  /// nothing where that is not known.
  virtual std::optional<network::peer_identity>
  identity_of(const caf::node_id& process) const = 0;

  /// Makes an acceptor public on this machine alone.
  /// @param port  0: any.
  /// @returns the port.
  /// @throws input_error when that is not possible.
  virtual std::uint16_t publish(const messages::acceptor_actor& acceptor,
                                std::uint16_t port) = 0;

  /// May take a while; for several threads.
  /// @param port  On this machine.
  /// @returns the acceptor, or why there is none.
  virtual std::variant<messages::acceptor_actor, std::string>
  connect(std::uint16_t port) = 0;
};

/// A discrete-event world; begins at time zero, deterministic.
/// @param pool  Whose helpers compute, too; null: there are none.
std::unique_ptr<runtime>
make_virtual_runtime(std::shared_ptr<job_pool> pool = nullptr);

/// CAF's own scheduler and the machine's steady clock.
std::unique_ptr<runtime> make_wall_clock_runtime();

/// The same, with a ledger of who takes how much computing time.
std::unique_ptr<runtime> make_accounting_runtime();

/// The same, for one process of several.
/// @param clock  For tests: how far its clock is off, from now on.
std::unique_ptr<network_runtime>
make_network_runtime(actors::clock_error clock = {});

} // namespace sofof::scenario
