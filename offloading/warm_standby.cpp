// When a vehicle's own function of a service runs along.
#include "offloading/warm_standby.hpp"

#include <algorithm>

namespace sofof::offloading {

namespace {

/// So much of a limit may be used up before that is a sign.
constexpr duration most_of(duration limit) {
  return limit / 4 * 3;
}

} // namespace

void warm_standby::begin(time_point now) {
  last_ = now;
  foresee(now);
}

void warm_standby::foresee(time_point now) {
  if (is_on())
    until_ = std::max(until_.value_or(now), now + time_);
}

void warm_standby::on_used(time_point created, time_point input_at,
                           time_point now) {
  last_ = now;
  if (now - created > most_of(limits_.max_latency)
      || now - input_at > most_of(limits_.max_input_age))
    foresee(now);
}

time_point warm_standby::missed_at() const {
  return last_ + most_of(limits_.max_interarrival);
}

} // namespace sofof::offloading
