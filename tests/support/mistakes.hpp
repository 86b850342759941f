// Files with one mistake, and what is said about it.
#pragma once

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::test {

/// One mistake: a right text of which `right` is replaced by `wrong`. A `@` in
/// `wrong` marks the place that has to be named; it is taken out.
struct mistake {
  std::string_view right;
  std::string_view wrong;
  std::vector<std::string_view> says;
};

/// Takes the mark out of a text.
/// @returns its place, ":LINE:COLUMN: ".
inline std::string take_mark(std::string& text) {
  const auto mark = text.find('@');
  REQUIRE(mark != text.npos);
  const auto before = text.substr(0, mark);
  text.erase(mark, 1);
  const auto line = std::ranges::count(before, '\n') + 1;
  const auto line_start = before.rfind('\n') + 1; // npos + 1 is 0
  return fmt::format(":{}:{}: ", line, mark - line_start + 1);
}

/// Checks that an error is one sentence with a place and these words.
inline void check_says(const std::string& error, std::string_view place,
                       const std::vector<std::string_view>& words) {
  CAPTURE(error);
  CAPTURE(place);
  CHECK(error.find(place) != error.npos);
  for (const auto& w : words) {
    CAPTURE(w);
    CHECK(error.find(w) != error.npos);
  }
  CHECK(error.find('\n') == error.npos);
  CHECK(error.ends_with('.'));
}

} // namespace sofof::test
