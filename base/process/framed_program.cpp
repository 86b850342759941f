// Whoever reads or writes here does so without waiting, but between looks.
#include "base/process/framed_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace sofof {

namespace {

/// Steps that a program does not read; each has a header.
constexpr std::size_t most_waiting = 4096;

/// It is seen that a program has ended, whoever has its files open.
constexpr std::chrono::milliseconds between_looks{50};

std::span<const std::byte> octets_of(std::string_view text) {
  return std::as_bytes(std::span{text.data(), text.size()});
}

} // namespace

framed_program::framed_program(const child_setup& setup,
                               std::string_view configuration,
                               std::size_t most_octets)
    : child_{setup}, parser_{most_octets} {
  append_frame(waiting_, frame_kind::configure, 0, 0, octets_of(configuration));
  write_waiting();
}

bool framed_program::is_ready(clock::time_point until) {
  look();
  while (!is_ready_ && objection_.empty() && clock::now() < until
         && child_.wait(!waiting_.empty(), until))
    look();
  return is_ready_ && objection_.empty();
}

void framed_program::look() {
  write_waiting();
  read_some();
  // It may have ended though others still have its files open.
  if (const auto end = has_answered() ? std::nullopt : child_.poll_end()) {
    read_some(); // what it had sent before
    if (!has_answered() && objection_.empty())
      objection_ = end->in_words();
  }
}

void framed_program::tell(frame_kind kind, std::int64_t time_ns,
                          std::string_view lines) {
  if (!objection_.empty())
    return;
  append_frame(waiting_, kind, time_ns, 0, octets_of(lines));
  write_waiting();
  if (waiting_.size() > most_waiting)
    objection_ = "does not read what it is told";
}

std::optional<std::vector<std::byte>>
framed_program::exchange(std::int64_t time_ns, std::uint64_t number,
                         std::span<const std::byte> input,
                         clock::time_point until) {
  assert(number > newest_);
  if (!objection_.empty())
    return std::nullopt;
  newest_ = number;
  is_asked_ = true;
  append_frame(waiting_, frame_kind::input, time_ns, number, input);
  for (look(); !has_answered() && objection_.empty(); look()) {
    const auto now = clock::now();
    if (now >= until)
      objection_ = "did not answer in time";
    else
      child_.wait(!waiting_.empty(), std::min(until, now + between_looks));
  }
  is_asked_ = false;
  auto answer = std::exchange(answer_, std::nullopt);
  if (!answer || answer->kind != frame_kind::result)
    return std::nullopt;
  return std::move(answer->octets);
}

void framed_program::shut_down(std::int64_t time_ns,
                               std::chrono::milliseconds grace) {
  tell(frame_kind::shut_down, time_ns);
  if (objection_.empty())
    child_.await_end(grace);
  child_.stop(grace);
}

void framed_program::write_waiting() {
  while (!waiting_.empty() && objection_.empty()) {
    const auto count = child_.write_some(waiting_);
    if (!count) {
      read_some(); // what it has sent before
      if (!has_answered() && objection_.empty())
        object_to_end("closed its input");
      return;
    }
    if (*count == 0)
      return;
    waiting_.erase(waiting_.begin(),
                   waiting_.begin() + static_cast<std::ptrdiff_t>(*count));
  }
}

/// At most a few blocks, if it sends without end. What is behind an answer is
/// read with the next look: whether it is there already is a matter of chance.
void framed_program::read_some() {
  constexpr std::size_t block = 64 * 1024;
  constexpr int most_blocks = 16;
  std::array<std::byte, block> some;
  take_frames(); // that came with an answer
  for (int k = 0; k < most_blocks && objection_.empty() && !has_answered();
       ++k) {
    const auto count = child_.read_some(some);
    if (!count)
      return object_to_end("closed its output");
    if (*count == 0)
      return;
    parser_.add(std::span{some}.first(*count));
    take_frames();
  }
}

/// Answers to earlier inputs come too late, and of several to one the first
/// counts.
void framed_program::take_frames() {
  while (!has_answered() && objection_.empty()) {
    auto frame = parser_.next();
    if (!frame)
      break;
    if (frame->kind == frame_kind::ready)
      is_ready_ = true;
    else if (is_asked_ && frame->number == newest_)
      answer_ = std::move(*frame);
    else if (frame->number > newest_)
      objection_ = fmt::format("answered input {}, which it was not given",
                               frame->number);
  }
  if (!has_answered() && objection_.empty())
    objection_ = parser_.objection();
}

/// It neither reads nor writes any more: perhaps it has ended, and is reaped.
void framed_program::object_to_end(std::string_view otherwise) {
  constexpr std::chrono::milliseconds soon{100};
  const auto end = child_.await_end(soon);
  objection_ = end ? end->in_words() : std::string{otherwise};
}

} // namespace sofof
