// Turns words or lines into lines, one at a time.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace sofof {

/// What became of a line: text to print, or why there is none.
struct turned_line {
  std::string text;
  std::string error;
};

/// Turns each of the words or, for the word "-", each line of standard input
/// that is not blank, and prints it at once. What is wrong becomes a line
/// {"error": "...", "line": n} instead, counted from 1.
/// @returns an exit code: 1 if there was an error.
int line_by_line(const std::vector<std::string>& words,
                 const std::function<turned_line(const std::string&)>& turn);

} // namespace sofof
