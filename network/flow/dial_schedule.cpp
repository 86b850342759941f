// When a peer is called that may not answer, or may hang up.
#include "network/flow/dial_schedule.hpp"

namespace sofof::network {

void dial_schedule::pause(time_point now) {
  next_ = now + pauses_.next_wait(draws_.uniform(attempts_));
  ++attempts_;
}

bool dial_schedule::is_due(time_point now) const {
  const auto is_trying = trying_since_ && now - *trying_since_ <= patience_;
  return now >= next_ && !is_trying;
}

void dial_schedule::begin(time_point now) {
  trying_since_ = now;
  pause(now);
}

} // namespace sofof::network
