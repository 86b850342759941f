// Faults for tests: messages that get lost, come twice, or out of order.
#include "channel/link_faults.hpp"

#include <cassert>

namespace sofof::channel {

link_faults::link_faults(random_stream stream,
                         const link_fault_options& options)
    : stream_{stream}, options_{options},
      is_faultless_(options.loss <= 0 && options.duplicate <= 0
                    && options.reorder <= 0) {
  assert(options.loss >= 0 && options.loss <= 1);
  assert(options.duplicate >= 0 && options.duplicate <= 1);
  assert(options.reorder >= 0 && options.reorder <= 1);
}

link_faults::fate link_faults::draw(std::uint64_t number) const {
  enum lane : std::uint32_t { loss, duplicate, reorder, extra, copy };
  const auto happens = [&](double probability, lane l) {
    return probability > 0 && stream_.uniform(number, l) < probability;
  };
  const auto some_delay = [&](lane l) {
    return from_seconds(to_seconds(options_.longest_extra_delay)
                        * stream_.uniform(number, l));
  };
  fate result;
  result.lost = happens(options_.loss, loss);
  if (result.lost)
    return result;
  if (happens(options_.reorder, reorder))
    result.extra_delay = some_delay(extra);
  if (happens(options_.duplicate, duplicate))
    result.copy_after = some_delay(copy);
  return result;
}

} // namespace sofof::channel
