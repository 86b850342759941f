// Times at which a channel is interrupted: stalls, and the bad state of a
// fading channel.
#pragma once

#include "base/random.hpp"
#include "base/time.hpp"
#include "channel/delay_distribution.hpp"

#include <cstdint>
#include <optional>

namespace sofof::channel {

/// One interruption.
struct interruption {
  std::uint64_t number = 0; ///< From the first on, whoever notices it.
  time_point end;
};

/// Alternates between quiet times and interruptions, from time zero on.
/// Interruption n and the quiet before it are draws number n, so they are
/// where they are, whoever asks and however often.
class outage_process {
public:
  /// None at all.
  outage_process() = default;

  /// @param quiet   Time from the end of one to the begin of the next; not
  ///                always 0.
  /// @param length  Of one.
  outage_process(random_stream stream, delay_distribution quiet,
                 delay_distribution length);

  /// @param now  Not before that of earlier calls.
  /// @returns the interruption that `now` lies in (its begin lies inside, its
  /// end does not); nullopt between two.
  std::optional<interruption> at(time_point now);

private:
  void advance();

  random_stream stream_{0, "none"};
  delay_distribution quiet_;
  delay_distribution length_;
  std::uint64_t drawn_ = 0;
  time_point begin_ = time_point::max();
  time_point end_ = time_point::max();
};

} // namespace sofof::channel
