// Turns words or lines into lines, one at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace sofof::apps {

/// What became of a line: text to print, or why there is none.
struct turned_line {
  std::string text;
  std::string error;
};

/// Longer lines are none of ours: no message has even a hundredth of it.
inline constexpr std::size_t longest_line = 16 * 1024 * 1024;

/// Turns each of the words or, for the word "-", each line of standard input
/// that is not blank, and prints it at once. What is wrong becomes a line
/// {"error": "...", "line": n} instead, counted from 1.
/// A line beyond `longest_line` is wrong, and is not kept.
/// @returns an exit code: 1 if there was an error.
/// @throws input_error when standard input cannot be read.
int filter_lines(const std::vector<std::string>& words,
                 const std::function<turned_line(const std::string&)>& turn);

} // namespace sofof::apps
