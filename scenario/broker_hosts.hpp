// A scenario on several hosts that an AMQP broker connects.
#pragma once

#include "scenario/broker_connection.hpp"
#include "scenario/hosts.hpp"

namespace sofof::scenario {

/// Runs one provider, for vehicles that use the same broker.
/// @param what  Where it would listen is not used.
/// @throws input_error, network_error.
run_outcome provide_by_broker(const scenario_definition& s,
                              const provide_options& what,
                              const broker_options& broker, run_options options,
                              const std::atomic<bool>& interrupted,
                              std::ostream& console);

/// Runs vehicles, which all providers of the scenario plan for that use the
/// same broker.
/// @param what  Its providers are not used.
/// @throws input_error, network_error.
run_outcome drive_by_broker(const scenario_definition& s,
                            const drive_options& what,
                            const broker_options& broker, run_options options,
                            const std::atomic<bool>& interrupted,
                            std::ostream& console);

} // namespace sofof::scenario
