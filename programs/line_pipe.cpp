// Waiting for a line, but not for ever.
#include "programs/line_pipe.hpp"

#include "base/text/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <sys/socket.h>
#include <thread>
#include <utility>

namespace sofof::programs {

namespace {

using namespace std::chrono_literals;

/// A program has so long to exit after "bye", and again after SIGTERM.
constexpr auto time_to_exit = 1s;
/// One that has closed its output is about to exit, most likely.
constexpr auto time_to_die = 200ms;
constexpr auto between_looks = 1ms;

} // namespace

std::string quoted_line(std::string_view line) {
  constexpr std::size_t longest = 200;
  line = line.substr(0, line.find('\n'));
  std::string text{line.substr(0, longest)};
  for (auto& c : text) // cut off, or no UTF-8 from the beginning
    if (c < 0)
      c = '?';
  return printable(std::move(text)) + (line.size() > longest ? "..." : "");
}

std::string_view line_pipe::ask(std::string_view lines,
                                clock::time_point until) {
  tell(lines, until);
  auto end = came_.npos;
  while ((end = came_.find('\n')) == came_.npos) {
    if (came_.size() >= longest_answer)
      break;
    if (!read_some())
      lost();
    if (came_.find('\n') == came_.npos && !child_.wait(false, until))
      throw pipe_error{"did not answer in time"};
  }
  if (std::min(end, came_.size()) >= longest_answer)
    throw pipe_error{fmt::format("wrote a line of more than {} octets: {}",
                                 longest_answer, quoted_line(came_))};
  answered_ = came_.substr(0, end);
  came_.erase(0, end + 1);
  if (!came_.empty())
    throw pipe_error{fmt::format("wrote more than one line: after {} also {}",
                                 quoted_line(answered_), quoted_line(came_))};
  return answered_;
}

void line_pipe::tell(std::string_view lines, clock::time_point until) {
  expect_silence();
  auto left = std::as_bytes(std::span{lines});
  while (!left.empty()) {
    const auto count = child_.write_some(left);
    if (!count)
      lost();
    left = left.subspan(*count);
    if (left.empty())
      return;
    expect_silence();
    if (!child_.wait(true, until))
      throw pipe_error{"did not read what it was told in time"};
  }
}

void line_pipe::end(std::string_view lines) {
  try {
    tell(lines, clock::now() + time_to_exit);
  } catch (const pipe_error&) { // it ends either way
  }
  ::shutdown(child_.socket(), SHUT_WR);
  const auto last = clock::now() + time_to_exit;
  while (!child_.poll_end() && clock::now() < last)
    std::this_thread::sleep_for(between_looks);
  child_.stop(time_to_exit);
}

// Before it can complain that nobody reads any more.
void line_pipe::stop() {
  if (!child_.poll_end())
    child_.kill_now();
  child_.stop({});
}

/// @returns false if nothing will come any more.
bool line_pipe::read_some() {
  std::array<std::byte, 4096> block;
  const auto count = child_.read_some(block);
  if (!count)
    return false;
  assert(*count <= block.size());
  came_.append(reinterpret_cast<const char*>(block.data()), *count);
  return true;
}

void line_pipe::expect_silence() {
  if (!read_some())
    lost();
  if (!came_.empty())
    throw pipe_error{
        fmt::format("wrote what nobody had asked for: {}", quoted_line(came_))};
}

void line_pipe::lost() {
  const auto last = clock::now() + time_to_die;
  while (!child_.poll_end() && clock::now() < last)
    std::this_thread::sleep_for(between_looks);
  const auto ended = child_.poll_end();
  throw pipe_error{ended ? ended->in_words() : "closed its output"};
}

} // namespace sofof::programs
