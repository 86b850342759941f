// When a cycle is done, and what of the time until then was computing.
#pragma once

#include "base/time.hpp"

namespace sofof::offloading {

/// Between its start and `done` a cycle waits for who computes it, and is
/// computed.
struct cycle_work {
  time_point done;
  duration computing{}; ///< >= 0; the last part of it.

  /// @param done  Alone: as if all the time had been waiting.
  cycle_work(time_point done, duration computing = {})
      : done{done}, computing{computing} {}
};

} // namespace sofof::offloading
