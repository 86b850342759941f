// Reads on when the window holds no whole line.
#include "base/files/line_file.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

namespace sofof {

namespace {

constexpr std::size_t block_size = std::size_t{256} << 10;

} // namespace

line_file::line_file(const std::filesystem::path& file)
    : name_{file.string()}, file_{file} {
  read_on();
}

bool line_file::read_on() {
  window_.erase(0, at_);
  at_ = 0;
  const auto more = file_.read(window_, block_size) > 0;
  if (file_.error() != 0)
    throw input_error{fmt::format("{}: this file cannot be read: {}.", name_,
                                  file_.refusal())};
  return more;
}

std::optional<std::string_view> line_file::next() {
  auto end = window_.find('\n', at_);
  while (end == window_.npos) {
    const auto searched = window_.size() - at_;
    if (searched > longest_line)
      throw input_error{fmt::format("{}:{}: this line is longer than {} KiB.",
                                    name_, number_ + 1, longest_line >> 10)};
    if (!read_on())
      break;
    end = window_.find('\n', searched);
  }
  has_end_ = end != window_.npos;
  if (!has_end_)
    end = window_.size();
  if (!has_end_ && end == at_)
    return std::nullopt;
  ++number_;
  const auto line = std::string_view{window_}.substr(at_, end - at_);
  at_ = has_end_ ? end + 1 : end;
  return line;
}

} // namespace sofof
