// Text as words with one space between.
#pragma once

#include <algorithm>
#include <ranges>
#include <string>
#include <string_view>

namespace sofof {

inline void add_word(std::string& to, std::string_view word) {
  if (!to.empty())
    to += ' ';
  to += word;
}

/// @returns whether one of the words of `text` is `word`.
inline bool has_word(std::string_view text, std::string_view word) {
  return std::ranges::any_of(
      text | std::views::split(' '),
      [word](const auto& x) { return std::ranges::equal(x, word); });
}

} // namespace sofof
