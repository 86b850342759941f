// Tables as text: comma-separated, fixed decimals, the same bytes everywhere.
#pragma once

#include "base/files/output_file.hpp"
#include "base/time.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace sofof {

/// A number with a fixed count of decimals, held exactly; nullopt is an
/// empty field.
struct decimal {
  std::optional<std::int64_t> digits; ///< The number · 10^places.
  int places = 0;                     ///< 0 … 18.
};

/// Seconds, exact to the nanosecond.
constexpr decimal seconds(duration d) {
  return {d.count(), 9};
}

/// Milliseconds, exact to the nanosecond; nullopt is an empty field.
constexpr decimal milliseconds(std::optional<duration> d) {
  return {d ? std::optional{d->count()} : std::nullopt, 6};
}

/// @param places  0 … 9.
/// @returns x rounded; an empty field when x is not finite, absent, or too
/// large for an integer of 64 bits.
decimal rounded(std::optional<double> x, int places);

/// Appends a number as text, "-0.050" for {-50, 3}; nothing when absent.
void append(std::string& out, decimal x);
void append(std::string& out, std::uint64_t x);
/// Appends a text, in quotes where it needs them (RFC 4180).
void append(std::string& out, std::string_view x);

/// What may stand in a field; a bool is 1 or 0.
using csv_field = std::variant<decimal, std::string_view, std::uint64_t>;

/// One column of a table: its name, and what of a row stands in it.
template <class Row>
struct csv_column {
  std::string_view name;
  csv_field (*field)(const Row&);

  /// @param of  Without captures: gives what makes a `csv_field` of a row,
  ///            which keeps texts alive.
  template <class Of>
  constexpr csv_column(std::string_view name, Of)
      : name{name}, field{[](const Row& row) -> csv_field {
          return std::invoke(Of{}, row);
        }} {}
};

/// The columns of a table, in their order; outlived by their array.
template <class Row>
using csv_columns = std::span<const csv_column<Row>>;

/// Appends their names, separated by commas.
template <class Row>
void append_names(std::string& out, csv_columns<Row> columns) {
  for (const auto& column : columns) {
    if (&column != &columns.front())
      out += ',';
    out += column.name;
  }
}

/// Appends what stands in them, separated by commas.
template <class Row>
void append_fields(std::string& out, csv_columns<Row> columns, const Row& row) {
  for (const auto& column : columns) {
    if (&column != &columns.front())
      out += ',';
    std::visit([&out](const auto& x) { append(out, x); }, column.field(row));
  }
}

/// A CSV file, row by row, as its columns say.
template <class Row>
class csv_file {
public:
  /// @param columns  Outlive it.
  csv_file(std::filesystem::path path, csv_columns<Row> columns)
      : columns_{columns}, file_{std::move(path)} {
    append_names(file_.text(), columns_);
    file_.text() += '\n';
  }

  void write(const Row& row) {
    append_fields(file_.text(), columns_, row);
    file_.text() += '\n';
    file_.end_line();
  }

  void flush() { file_.flush(); }
  void close() { file_.close(); }

private:
  csv_columns<Row> columns_;
  output_file file_;
};

} // namespace sofof
