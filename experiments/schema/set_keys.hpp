// What can stand behind --set.
#pragma once

#include "base/options/option_tree.hpp"

#include <string>
#include <vector>

namespace sofof::experiments::schema {

/// An option by its dotted path.
struct set_key {
  /// Of a list of tables the first: "fleet.0.count"; of one that goes by kinds
  /// the kind: "service.trajectory_planning.period".
  std::string key;
  std::vector<std::string> values; ///< All there are; none: any.
};

/// @returns all that there are, without former places, in the order of the
/// file; each once.
std::vector<set_key> set_keys(const option_table& all);

} // namespace sofof::experiments::schema
