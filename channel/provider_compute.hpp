// A provider's computers: how many there are, and how long each takes.
#pragma once

#include "base/random.hpp"
#include "base/time.hpp"
#include "channel/delay_distribution.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace sofof::channel {

/// A provider has no more of them.
inline constexpr std::int64_t most_workers = 1024;

/// All that tells one provider's computers from another's. Whoever needs the
/// computing time of a result, or its mean, has it from here.
struct provider_compute {
  /// The channel profile with which the computing times were measured.
  std::string model = "ideal";
  std::int64_t workers = 1; ///< Each computes one result at a time; >= 1.

  delay_distribution alone; ///< Computing time that the network does not know.
  /// One draw X a result, which the channel has in common: `joint_share` · X
  /// is computing time.
  delay_distribution joint;
  double joint_share = 0; ///< In [0, 1].

  duration more_computing{}; ///< On top of each draw; >= 0.

  double worker_w = 0;      ///< What a busy worker takes beyond an idle one, W,
  double worker_idle_w = 0; ///< and what that one takes.

  /// @param draws   Of one vehicle at this provider, see `result_draws`.
  /// @param cycle   The number of the result.
  /// @param demand  Of its service, >= 0.
  /// @returns how long a worker computes it.
  duration computing_time(const random_stream& draws, std::uint64_t cycle,
                          double demand = 1) const;

  /// @returns the mean computing time of a result of unit demand, s.
  double mean_s() const;

  /// @returns its standard deviation, s.
  double deviation_s() const;

  /// @returns what no computing time of a result of unit demand exceeds, but
  /// for few where a law has no end.
  draw_bound bound() const;
};

/// @param profile  The name of a channel profile.
/// @returns the computers that results came from when it was measured; where
/// only whole round trips are known, one that takes no time.
provider_compute compute_measured_with(std::string_view profile);

} // namespace sofof::channel
