// What is to be told of a file that could be read.
#pragma once

#include <string>

namespace sofof {

/// Somebody should change the file, but need not yet.
struct option_note {
  std::string place; ///< `FILE:LINE:COLUMN`, or `--set KEY=VALUE`.
  std::string text;  ///< A sentence on it.

  bool operator==(const option_note&) const = default;
};

} // namespace sofof
