// Which of several functions a core computes that has to choose.
#pragma once

namespace sofof {

/// Each interrupts those that come after it.
enum class core_order {
  fixed_priority, ///< The first in a given order comes first.
  edf,            ///< Whose deadline comes first; of equals, as above.
};

} // namespace sofof
