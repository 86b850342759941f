// Latencies that were measured over an AMQP broker.
#pragma once

#include "channel/trace.hpp"

#include <vector>

namespace sofof::channel {

/// @returns latencies of planning results of six cars over `sofof broker`, all
/// processes on one machine: computing, both hops and the waits of a machine
/// with two cores, without any radio. docs/broker.md says how they were
/// measured.
std::vector<trace_sample> measured_over_amqp();

} // namespace sofof::channel
