// What is thrown when a file, or what was typed, cannot be used.
#pragma once

#include <stdexcept>

namespace sofof {

/// One sentence for the user: where (`FILE:LINE:COLUMN:` or `--set KEY=VALUE:`
/// in front), what is wrong, and what would be right.
class input_error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

} // namespace sofof
