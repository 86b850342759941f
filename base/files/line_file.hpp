// A long text file, line by line.
#pragma once

#include "base/files/regular_file.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sofof {

/// A regular file of which a block or a line is in memory, whichever is longer.
class line_file {
public:
  /// A line is refused once so much of it is read and no end is there; bytes.
  /// No line that SOFOF writes comes near it.
  static constexpr std::size_t longest_line = std::size_t{1} << 20;

  /// @throws input_error when it cannot be read, as `next` does.
  explicit line_file(const std::filesystem::path& file);

  /// @returns the next line without its end, until the next call; nullopt
  /// after the last one.
  std::optional<std::string_view> next();

  /// @returns whether the line that `next` gave had an end.
  bool has_end() const { return has_end_; }
  /// @returns its number, from 1 on.
  std::size_t number() const { return number_; }

private:
  bool read_on();

  std::string name_;
  regular_file file_;
  std::string window_;
  std::size_t at_ = 0; // of the next line, in the window
  std::size_t number_ = 0;
  bool has_end_ = false;
};

} // namespace sofof
