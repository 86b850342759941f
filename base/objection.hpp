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

/// How far a result that is used stays within a limit.
struct margin {
  std::string_view name; ///< Of the check, with its unit; a literal.
  double left = 0;       ///< Negative: beyond, and excused.
};

} // namespace sofof
