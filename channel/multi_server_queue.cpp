// A queue before a few equal servers.
#include "channel/multi_server_queue.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace sofof::channel {

multi_server_queue::multi_server_queue(unsigned workers)
    : free_at_(workers, time_point::min()) {
  if (workers == 0)
    throw std::invalid_argument{"a queue needs at least one worker"};
}

time_point multi_server_queue::finish(time_point now, duration work) {
  assert(work >= duration{0});
  const std::lock_guard lock{mutex_};
  last_arrival_ = std::max(last_arrival_, now);
  const auto first_free = std::ranges::min_element(free_at_);
  *first_free = std::max(*first_free, last_arrival_) + work;
  return *first_free;
}

} // namespace sofof::channel
