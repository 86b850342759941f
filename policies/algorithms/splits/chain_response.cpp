// The parts of a response, one after the other.
#include "policies/algorithms/splits/chain_response.hpp"

#include "base/protocol.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace sofof::policies {

namespace {

/// @param every  Something comes so often, > 0; becomes how often it goes up.
/// @returns how long it takes until what stands in for it goes up.
time_law until_sent(duration& every, duration input_period) {
  const auto of =
      std::max<duration::rep>(1, (input_period + every - duration{1}) / every);
  time_law wait;
  for (duration::rep k = 0; k < of; ++k)
    wait.add(k * every);
  every *= of;
  return wait;
}

} // namespace

time_law predicted_response(std::span<const service_times> chain,
                            const chain_split& split) {
  assert(chain.size() == split.size());
  auto sum = time_law::exactly(duration{0});
  time_law arrived; // at the first of those that run at one provider
  auto every = protocol::sensor_period;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const auto& service = chain[k];
    const auto wait = [&service](const time_law& until) {
      return service.period > duration{0}
                 ? after(until, time_law::uniform(service.period))
                 : until;
    };
    if (!split[k]) {
      sum = after(wait(sum), service.on_board);
      continue;
    }
    const auto there = service.at.find(*split[k]);
    if (there == service.at.end())
      return {};
    const auto& [up, computing, down] = there->second;
    const auto goes_on = k > 0 && split[k - 1] == split[k];
    const auto asks_there = goes_on && service.period > duration{0};
    const auto begins =
        asks_there
            ? arrived
            : after(after(sum, until_sent(every, service.input_period)), up);
    if (!goes_on)
      arrived = begins;
    sum = after(after(wait(begins), computing), down);
  }
  return until_multiple_of(protocol::control_period, sum);
}

} // namespace sofof::policies
