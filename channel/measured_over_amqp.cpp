// Made by tests/acceptance/wire_parts/measured_delays; see there.
#include "channel/measured_over_amqp.hpp"

namespace sofof::channel {

std::vector<trace_sample> measured_over_amqp() {
  return {{0, 0.002}, {0.05, 0.003}};
}

} // namespace sofof::channel
