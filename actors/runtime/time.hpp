// The only place where actors read a clock or set a timer, so that the same
// actor runs in virtual and in wall-clock time.
#pragma once

#include "base/time.hpp"

#include <caf/actor_clock.hpp>
#include <caf/actor_system.hpp>

#include <functional>
#include <utility>

namespace sofof::actors {

/// @returns the time of the run that `self` lives in.
template <class Self>
time_point now(const Self* self) {
  return time_point{self->clock().now().time_since_epoch()};
}

/// @returns the time of the run that all actors of a system live in.
inline time_point now(caf::actor_system& sys) {
  return time_point{sys.clock().now().time_since_epoch()};
}

/// @returns the same as a function, for those that are no actors. It must not
/// outlive the actor system.
template <class Self>
std::function<time_point()> clock_of(const Self* self) {
  return [clock = &self->clock()] {
    return time_point{clock->now().time_since_epoch()};
  };
}

/// Delivers a message at `t`, or at once if that has passed. Messages for the
/// same moment arrive in the order of these calls. To cancel, carry a number
/// in the message and stop expecting it.
template <class Self, class Receiver, class... Ts>
void send_at(Self* self, const Receiver& receiver, time_point t, Ts&&... xs) {
  self->scheduled_send(receiver,
                       caf::actor_clock::time_point{t.time_since_epoch()},
                       std::forward<Ts>(xs)...);
}

/// Delivers a message after `d`.
template <class Self, class Receiver, class... Ts>
void send_after(Self* self, const Receiver& receiver, duration d, Ts&&... xs) {
  send_at(self, receiver, now(self) + d, std::forward<Ts>(xs)...);
}

} // namespace sofof::actors
