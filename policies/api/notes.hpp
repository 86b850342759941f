// What users are told of a policy, a filter or a governor.
#pragma once

#include <string_view>
#include <vector>

namespace sofof::policies {

/// One option of it.
struct option_info {
  std::string_view name;
  std::string_view unit; ///< "1" for a number without; of words, what they are.
  std::string_view meaning;
};

struct policy_info {
  std::string_view name;
  std::string_view summary; ///< What it does, in a line.
  std::string_view rule;    ///< What it decides by.
  std::string_view sees;    ///< What it needs to know.
  std::string_view source;
  /// Its options, without those of the filter before it and the governors after
  /// it.
  std::vector<option_info> parameters{};
};

} // namespace sofof::policies
