// Rows, fields and numbers, each with its place when it is wrong.
#include "base/text/csv_reader.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace sofof {

namespace {

template <class T>
bool parse(std::string_view text, T& value) {
  const auto* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc{} && end == last;
}

} // namespace

csv_reader::csv_reader(const std::filesystem::path& file,
                       std::span<const std::string_view> wanted, ending end,
                       std::span<const std::string_view> optional)
    : file_{file.string()}, lines_{file}, was_killed_{end == ending::killed},
      wanted_(wanted.begin(), wanted.end()) {
  if (!read_row() && was_killed_)
    return; // before its first line
  if (count_ == 0)
    throw input_error{fmt::format("{}: the file is empty; its first line "
                                  "should name its columns.",
                                  file_)};
  header_.assign(fields_.begin(),
                 fields_.begin() + static_cast<std::ptrdiff_t>(count_));
  const auto place_of = [this](std::string_view name) {
    const auto found = std::ranges::find(header_, name);
    return found == header_.end()
               ? missing
               : static_cast<std::size_t>(found - header_.begin());
  };
  for (const auto& name : wanted_) {
    places_.push_back(place_of(name));
    if (places_.back() == missing)
      refuse(fmt::format("the column \"{}\" is missing.", name));
  }
  for (const auto name : optional) {
    wanted_.emplace_back(name);
    places_.push_back(place_of(name));
  }
}

bool csv_reader::next() {
  const auto columns = count_;
  if (!read_row())
    return false;
  if (count_ != columns)
    refuse(fmt::format("{} fields stand here, but the first line names {} "
                       "columns.",
                       count_, columns));
  return true;
}

/// Takes as many lines as belong to the next row.
bool csv_reader::take_row() {
  row_.clear();
  bool quoted = false;
  for (;;) {
    const auto line = lines_.next();
    if (!line || (was_killed_ && !lines_.has_end()))
      break;
    if (row_.empty())
      line_ = lines_.number();
    row_ += *line;
    if (!lines_.has_end())
      break;
    row_ += '\n';
    quoted ^= std::ranges::count(*line, '"') % 2 == 1;
    if (!quoted)
      break;
    if (row_.size() > line_file::longest_line)
      refuse("a quote is opened in this line and not closed.");
  }
  at_ = 0;
  return !row_.empty();
}

bool csv_reader::read_row() {
  if (!take_row())
    return false;
  for (std::size_t i = 0;; ++i) {
    if (i == fields_.size())
      fields_.emplace_back();
    auto& field = fields_[i];
    field.clear();
    if (at_ < row_.size() && row_[at_] == '"') {
      read_quoted(field);
    } else {
      const auto end = std::min(row_.find_first_of(",\n", at_), row_.size());
      field.assign(row_, at_, end - at_);
      at_ = end;
    }
    if (at_ == row_.size())
      refuse("this line is cut off.");
    if (row_[at_++] == ',')
      continue;
    count_ = i + 1;
    return true;
  }
}

void csv_reader::read_quoted(std::string& field) {
  for (++at_; at_ < row_.size(); ++at_) {
    const auto c = row_[at_];
    if (c == '"') {
      const auto next = at_ + 1 < row_.size() ? row_[at_ + 1] : '\0';
      if (next == ',' || next == '\n') {
        ++at_;
        return;
      }
      if (next != '"')
        break;
      ++at_;
    }
    field += c;
  }
  refuse(at_ + 1 < row_.size() ? "a quote stands within a field."
                               : "this line is cut off.");
}

double csv_reader::number(std::size_t column) const {
  double value = 0;
  if (!parse(text(column), value) || !std::isfinite(value))
    refuse(column, "is not a number");
  return value;
}

std::optional<double> csv_reader::number_if_any(std::size_t column) const {
  return text(column).empty() ? std::nullopt : std::optional{number(column)};
}

std::uint64_t csv_reader::whole(std::size_t column) const {
  std::uint64_t value = 0;
  if (!parse(text(column), value))
    refuse(column, "is not a whole number");
  return value;
}

bool csv_reader::flag(std::size_t column) const {
  if (text(column) != "0" && text(column) != "1")
    refuse(column, "is neither 0 nor 1");
  return text(column) == "1";
}

void csv_reader::refuse(std::size_t column, std::string_view why) const {
  refuse(fmt::format("{} \"{}\" {}.", wanted_[column], text(column), why));
}

void csv_reader::refuse(std::string_view why) const {
  throw input_error{fmt::format("{}:{}: {}", file_, line_, why)};
}

} // namespace sofof
