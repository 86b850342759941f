// Erlang's formula C, by his formula B.
#include "channel/core_wait.hpp"

#include "channel/draw_lanes.hpp"

#include <cassert>

namespace sofof::channel {

namespace {

/// @returns the cores that so many vehicles keep busy.
double busy_cores(const host_options& host, std::int64_t vehicles) {
  return host.busy_cores * static_cast<double>(vehicles);
}

} // namespace

bool host_options::carries(std::int64_t vehicles) const {
  return cores == 0
         || sofof::channel::busy_cores(*this, vehicles)
                < static_cast<double>(cores);
}

duration core_wait::draw(const random_stream& stream,
                         std::uint64_t number) const {
  if (probability <= 0 || stream.uniform(number, host_lane) >= probability)
    return {};
  return from_seconds(
      stream.exponential(to_seconds(mean), number, host_wait_lane));
}

core_wait wait_for_core(const host_options& host, std::int64_t vehicles) {
  assert(host.carries(vehicles));
  const auto busy = busy_cores(host, vehicles);
  if (host.cores == 0 || busy <= 0)
    return {};
  double lost = 1; // of calls, where nobody waits: formula B
  for (std::int64_t k = 1; k <= host.cores; ++k)
    lost = busy * lost / (static_cast<double>(k) + busy * lost);
  const auto cores = static_cast<double>(host.cores);
  const auto free = cores - busy;
  return {lost / (1 - busy / cores * (1 - lost)),
          from_seconds(to_seconds(host.turn) / free)};
}

} // namespace sofof::channel
