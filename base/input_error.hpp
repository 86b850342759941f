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

/// A sentence of the same kind about a disk that is full, broken or read-only:
/// nothing that was typed is wrong.
class storage_error : public input_error {
public:
  using input_error::input_error;
};

} // namespace sofof
