// When a peer is called that may not answer, or may hang up.
#pragma once

#include "base/random.hpp"
#include "base/time.hpp"
#include "network/flow/exponential_backoff.hpp"

#include <cstdint>
#include <optional>

namespace sofof::network {

/// Attempts at a connection: one at a time, with pauses between the beginning
/// of one and that of the next (`exponential_backoff`).
class dial_schedule {
public:
  /// @param draws     For the pauses.
  /// @param patience  An attempt that has not ended after so long hangs: the
  ///                  next one does not wait for it.
  dial_schedule(random_stream draws, duration patience)
      : draws_{draws}, patience_{patience} {}

  /// A pause begins, and an attempt follows it.
  void pause(time_point now);

  /// @returns whether an attempt shall begin. Beside one that is not over it
  /// would wait for the same connection, and end with it.
  bool is_due(time_point now) const;

  /// An attempt begins, and with it the pause before the next one.
  void begin(time_point now);

  /// The attempt is over, with a connection or without.
  void end() { trying_since_.reset(); }

  /// The peer has proved itself: pauses are short again. One that accepts and
  /// hangs up has not.
  void succeeded() { pauses_.succeeded(); }

private:
  random_stream draws_;
  duration patience_;
  exponential_backoff pauses_;
  std::uint64_t attempts_ = 0;
  time_point next_{};
  std::optional<time_point> trying_since_;
};

} // namespace sofof::network
