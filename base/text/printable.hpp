// Words of strangers, for people to read.
#pragma once

#include <string>

namespace sofof {

/// @returns the text as one line that is not too long and does nothing to a
/// terminal.
inline std::string printable(std::string text) {
  constexpr std::size_t longest = 1000;
  if (text.size() > longest)
    text.resize(longest);
  for (auto& c : text)
    if ((c >= 0 && c < ' ') || c == '\x7f')
      c = '?';
  return text;
}

} // namespace sofof
