// How long a vehicle stays away from a provider whose result was refused.
#pragma once

#include "base/time.hpp"

#include <cstdint>

namespace sofof::offloading {

/// What a vehicle remembers of one provider's refused results: 60 s without a
/// request after the first, twice as long after each further one; longer than
/// a drive soon.
class distrust {
public:
  /// A result was implausible.
  /// @returns for how long nothing is asked there.
  duration add(time_point now);

  bool holds(time_point now) const { return now < until_; }

private:
  std::uint32_t refused_ = 0;
  time_point until_ = time_point::min();
};

} // namespace sofof::offloading
