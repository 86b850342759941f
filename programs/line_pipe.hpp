// Lines to a program and back, each within a time.
#pragma once

#include "base/process/child.hpp"

#include "programs/answers.hpp"
#include <chrono>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sofof::programs {

/// Why a program no longer answers; continues a sentence about it.
class pipe_error : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// @returns the first line of a text, cut where it is long, for people.
std::string quoted_line(std::string_view text);

/// A child that answers a line with a line, and says nothing else.
class line_pipe {
public:
  using clock = child::clock;

  /// Starts it. @throws input_error when the system refuses that.
  explicit line_pipe(const child_setup& setup) : child_{setup} {}

  /// @param lines  With their ends; the last one is to be answered.
  /// @returns the answer, without its end, valid until the next call.
  /// @throws pipe_error when there is none by then, or more than one.
  std::string_view ask(std::string_view lines, clock::time_point until);

  /// Writes lines that nobody answers. @throws pipe_error.
  void tell(std::string_view lines, clock::time_point until);

  /// Tells the last lines, gives the program a second to exit, and ends it.
  void end(std::string_view lines);

  /// Ends it at once.
  void stop();

private:
  bool read_some();
  void expect_silence();
  [[noreturn]] void lost();

  child child_;
  std::string came_;     // and was not handed out
  std::string answered_; // handed out last
};

} // namespace sofof::programs
