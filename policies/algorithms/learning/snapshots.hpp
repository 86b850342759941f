// What learners have learned that come with the program.
#pragma once

#include <string_view>

namespace sofof::policies {

/// @returns the text of policies/algorithms/learning/snapshots/NAME.txt; an
/// empty one if there is no such file.
std::string_view snapshot_of(std::string_view name);

} // namespace sofof::policies
