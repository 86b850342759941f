// Keeps a connection to another host alive, and knows how its clock stands.
#pragma once

#include "base/protocol.hpp"
#include "messages/protocol/remote.hpp"
#include "network/flow/clock_estimate.hpp"

#include <algorithm>
#include <optional>

namespace sofof::actors {

/// How often both sides ask, and how long one of them may be silent.
struct heartbeat_pace {
  duration period = protocol::ping_period;
  duration silence_limit = protocol::silence_limit;
};

/// One side of a connection; both ask and answer alike.
class heartbeat {
public:
  /// @param now              When the connection was made.
  /// @param time_of_day_gap  How much later the peer's clock stood at 0 than
  ///                         ours, as their times of day tell.
  heartbeat(time_point now, duration time_of_day_gap, heartbeat_pace pace = {})
      : pace_{pace}, alive_{now}, next_{now}, time_of_day_gap_{
                                                  time_of_day_gap} {}

  /// @returns whether the next question is to be asked.
  bool is_due(time_point now) const { return now >= next_; }

  messages::ping beat(time_point now) {
    next_ = now + pace_.period;
    return {++beats_, now};
  }
  static messages::pong answer(const messages::ping& sign, time_point now) {
    return {sign, now, now};
  }

  void on_pong(const messages::pong& echo, time_point now) {
    // It lived when the ping came, and no pong is older than its ping.
    alive_ = std::max(alive_, std::min(echo.of.sent, now));
    clocks_.add({echo.of.sent, echo.received, echo.answered, now});
  }

  /// Whether it has left unanswered, or answered too late, what was sent since
  /// the limit of silence: what else comes from it may be as old, or come
  /// from what still works of it.
  bool is_lost(time_point now) const {
    return now - alive_ > pace_.silence_limit;
  }

  /// @returns how far the peer's clock is ahead of ours; nothing at first.
  std::optional<network::clock_offset> clock(time_point now) const {
    return clocks_.at(now);
  }

  /// @returns how far its time of day is ahead of ours, given the former.
  duration time_of_day(const network::clock_offset& clock) const {
    return clock.ahead + time_of_day_gap_;
  }

private:
  heartbeat_pace pace_;
  time_point alive_;
  time_point next_; // question
  duration time_of_day_gap_;
  std::uint64_t beats_ = 0;
  network::clock_estimate clocks_;
};

} // namespace sofof::actors
