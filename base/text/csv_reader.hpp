// Reads a table that a run has written, row by row, and believes nothing.
#pragma once

#include "base/files/line_file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// A CSV file with a header (RFC 4180). Columns are asked for by their place
/// among those wanted; columns that nobody wants are skipped. Everything
/// throws input_error with file and line when the file is not as it should be.
class csv_reader {
public:
  /// How a file may end.
  enum class ending {
    whole,  ///< With a whole line.
    killed, ///< Anywhere: what follows the last line end is dropped.
  };

  /// @param wanted    Names of columns that must be there.
  /// @param optional  Names of columns that may be missing; their places
  ///                  follow those of `wanted`.
  csv_reader(const std::filesystem::path& file,
             std::span<const std::string_view> wanted,
             ending end = ending::whole,
             std::span<const std::string_view> optional = {});

  /// Goes on to the next row. @returns false after the last one.
  bool next();

  /// @returns whether the file has a column at all.
  bool has(std::size_t column) const {
    return column < places_.size() && places_[column] != missing;
  }

  /// Of a column that the file has, as all below.
  const std::string& text(std::size_t column) const {
    return fields_[places_[column]];
  }
  double number(std::size_t column) const; ///< Finite.
  std::optional<double> number_if_any(std::size_t column) const;
  std::uint64_t whole(std::size_t column) const;
  bool flag(std::size_t column) const; ///< 1 or 0.

  /// @returns the names of all columns, in the order of the file.
  std::span<const std::string> header() const { return header_; }
  /// @returns this row's text below one of these.
  const std::string& field(std::size_t i) const { return fields_[i]; }

  /// @returns that of this row, from 1 on.
  std::size_t line() const { return line_; }

  /// Says what is wrong with a field of this row.
  [[noreturn]] void refuse(std::size_t column, std::string_view why) const;

private:
  static constexpr std::size_t missing = -1;

  bool take_row();
  bool read_row();
  void read_quoted(std::string& field);
  [[noreturn]] void refuse(std::string_view why) const;

  std::string file_;
  line_file lines_;
  bool was_killed_ = false;
  std::string row_;      // its line, or lines where a field has some
  std::size_t at_ = 0;   // of the next field, in the row
  std::size_t line_ = 0; // of this row
  std::vector<std::string> wanted_;
  std::vector<std::string> header_;
  std::vector<std::size_t> places_; // of the columns wanted
  std::vector<std::string> fields_;
  std::size_t count_ = 0; // of the row's fields
};

} // namespace sofof
