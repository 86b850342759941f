// The only place where actors read a clock or set a timer, so that the same
// actor runs in virtual and in wall-clock time.
#pragma once

#include "base/time.hpp"

#include <caf/action.hpp>
#include <caf/actor_cast.hpp>
#include <caf/actor_clock.hpp>
#include <caf/actor_control_block.hpp>
#include <caf/actor_system.hpp>
#include <caf/error.hpp>
#include <caf/message.hpp>
#include <caf/sec.hpp>
#include <caf/system_messages.hpp>

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

/// The same in virtual time with a message that `make` makes by then; without
/// one nothing is delivered.
/// @param make  Returns an optional, at `t`. What it throws ends `self`.
template <class Self, class Receiver, class Make>
void send_made_at(Self* self, const Receiver& receiver, time_point t,
                  Make make) {
  auto deliver = [from = caf::actor_cast<caf::strong_actor_ptr>(self),
                  to = caf::actor_cast<caf::strong_actor_ptr>(receiver),
                  make = std::move(make)]() mutable {
    try {
      if (auto made = make())
        to->enqueue(from, caf::make_message_id(),
                    caf::make_message(std::move(*made)), nullptr);
    } catch (...) {
      const caf::error failed{caf::sec::runtime_error};
      from->enqueue(nullptr, caf::make_message_id(),
                    caf::make_message(caf::exit_msg{from->address(), failed}),
                    nullptr);
    }
  };
  self->clock().schedule(caf::actor_clock::time_point{t.time_since_epoch()},
                         caf::make_action(std::move(deliver)));
}

/// Delivers a message after `d`.
template <class Self, class Receiver, class... Ts>
void send_after(Self* self, const Receiver& receiver, duration d, Ts&&... xs) {
  send_at(self, receiver, now(self) + d, std::forward<Ts>(xs)...);
}

} // namespace sofof::actors
