// The words of an attribute.
#pragma once

#include <string_view>
#include <vector>

namespace sofof::maps {

/// @returns the parts of a text between separators, without empty ones; line
/// breaks and tabs separate, too, where spaces do.
inline std::vector<std::string_view> split_words(std::string_view text,
                                                 char separator = ' ') {
  const auto ends = [separator](char c) {
    return c == separator
           || (separator == ' ' && (c == '\n' || c == '\t' || c == '\r'));
  };
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < text.size();) {
    auto end = i;
    while (end < text.size() && !ends(text[end]))
      ++end;
    if (end > i)
      words.push_back(text.substr(i, end - i));
    i = end + 1;
  }
  return words;
}

} // namespace sofof::maps
