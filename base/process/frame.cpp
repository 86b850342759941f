// All numbers are little endian, whatever the machine is.
#include "base/process/frame.hpp"

#include <fmt/format.h>

#include <cassert>
#include <limits>

namespace sofof {

namespace {

template <class Number>
void append_number(std::vector<std::byte>& to, Number x) {
  for (std::size_t k = 0; k < sizeof x; ++k)
    to.push_back(static_cast<std::byte>(x >> (8 * k)));
}

template <class Number>
Number number_at(std::span<const std::byte> from, std::size_t place) {
  Number x = 0;
  for (std::size_t k = 0; k < sizeof x; ++k)
    x |= static_cast<Number>(static_cast<Number>(from[place + k]) << (8 * k));
  return x;
}

bool is_of_program(std::uint16_t kind) {
  return kind >= static_cast<std::uint16_t>(frame_kind::ready)
         && kind <= static_cast<std::uint16_t>(frame_kind::no_result);
}

} // namespace

void append_frame(std::vector<std::byte>& to, frame_kind kind,
                  std::int64_t time_ns, std::uint64_t number,
                  std::span<const std::byte> octets) {
  assert(octets.size() <= std::numeric_limits<std::uint32_t>::max());
  append_number(to, static_cast<std::uint32_t>(octets.size()));
  append_number(to, static_cast<std::uint16_t>(kind));
  append_number(to, std::uint16_t{0});
  append_number(to, static_cast<std::uint64_t>(time_ns));
  append_number(to, number);
  to.insert(to.end(), octets.begin(), octets.end());
}

void frame_parser::add(std::span<const std::byte> octets) {
  left_.erase(left_.begin(),
              left_.begin() + static_cast<std::ptrdiff_t>(read_));
  read_ = 0;
  left_.insert(left_.end(), octets.begin(), octets.end());
}

std::optional<program_frame> frame_parser::next() {
  const auto left = std::span<const std::byte>{left_}.subspan(read_);
  if (!objection_.empty() || left.size() < frame_header_size)
    return std::nullopt;
  const auto length = number_at<std::uint32_t>(left, 0);
  const auto kind = number_at<std::uint16_t>(left, 4);
  const auto reserved = number_at<std::uint16_t>(left, 6);
  if (!is_of_program(kind) || reserved != 0)
    objection_ = fmt::format("sent a frame of kind {} with {} behind it; a "
                             "program sends 16 to 18, and 0",
                             kind, reserved);
  else if (length > most_octets_)
    objection_ = fmt::format("sent a frame of {} octets; {} are the most",
                             length, most_octets_);
  if (!objection_.empty() || left.size() - frame_header_size < length)
    return std::nullopt;
  const auto content = left.subspan(frame_header_size, length);
  read_ += frame_header_size + length;
  return program_frame{
      static_cast<frame_kind>(kind),
      static_cast<std::int64_t>(number_at<std::uint64_t>(left, 8)),
      number_at<std::uint64_t>(left, 16),
      {content.begin(), content.end()}};
}

} // namespace sofof
