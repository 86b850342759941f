// Text on a console: in colours on a terminal, in columns everywhere.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace sofof {

class terminal_style {
public:
  /// @param colour  The console is a terminal.
  explicit terminal_style(bool colour) : colour_{colour} {}

  std::string heading(std::string_view text) const { return paint("1", text); }
  std::string good(std::string_view text) const { return paint("32", text); }
  std::string bad(std::string_view text) const { return paint("1;31", text); }

private:
  /// @param style  As terminals number them (ECMA-48, SGR).
  std::string paint(std::string_view style, std::string_view text) const {
    return colour_ ? fmt::format("\x1b[{}m{}\x1b[0m", style, text)
                   : std::string{text};
  }

  bool colour_;
};

/// @returns how many columns of a screen this takes: letters and signs of one
/// column each, in UTF-8.
inline std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

} // namespace sofof
