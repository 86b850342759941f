// Why a result of a service is not believed.
#pragma once

#include <string_view>

namespace sofof {

/// The check that a result fails, by how much.
struct objection {
  std::string_view check; ///< Its name, a literal.
  double value = 0;       ///< What was found, in the unit of the check.
  double limit = 0;       ///< What would have been accepted.
};

} // namespace sofof
