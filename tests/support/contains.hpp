// Whether a text says something.
#pragma once

#include <string_view>

namespace sofof::test {

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != text.npos;
}

} // namespace sofof::test
