// A child that talks in frames: one input is under way at a time.
#pragma once

#include "base/process/child.hpp"
#include "base/process/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// A program that runs and is talked to. What it does not read waits in a short
/// queue here, and no call waits for longer than it is told to.
class framed_program {
public:
  using clock = child::clock;

  /// Starts it, and tells it how it is configured.
  /// @param configuration  Lines KEY=VALUE.
  /// @param most_octets    Of a result.
  /// @throws input_error when it cannot be started.
  framed_program(const child_setup& setup, std::string_view configuration,
                 std::size_t most_octets);

  pid_t id() const { return child_.id(); }

  /// @returns why it is of no use any more, e.g. "was ended by signal 9
  /// (Killed)"; empty: nothing is known against it.
  const std::string& objection() const { return objection_; }

  /// Whether it has said that it is configured, by now or until then.
  bool is_ready(clock::time_point until);

  /// Reads what it has sent, and looks whether it has ended; at once.
  void look();

  /// Tells it something; it is sent as soon as it reads.
  /// @param lines  KEY=VALUE, or nothing.
  void tell(frame_kind kind, std::int64_t time_ns, std::string_view lines = {});

  /// Gives it an input and waits for the answer.
  /// @param number  Higher than those before.
  /// @returns its result, the first one; nullopt if the program says that there
  /// is none, or if there is an objection. What it does after its answer is
  /// found out later.
  std::optional<std::vector<std::byte>>
  exchange(std::int64_t time_ns, std::uint64_t number,
           std::span<const std::byte> input, clock::time_point until);

  /// Tells it to shut down, and ends it if it does not.
  /// @param grace  Twice: to end itself, and after SIGTERM.
  void shut_down(std::int64_t time_ns, std::chrono::milliseconds grace);

private:
  bool has_answered() const { return answer_.has_value(); }
  void write_waiting();
  void read_some();
  void take_frames();
  void object_to_end(std::string_view otherwise);

  child child_;
  frame_parser parser_;
  std::vector<std::byte> waiting_; // to be written
  bool is_ready_ = false;
  std::uint64_t newest_ = 0;            // input that it was given
  bool is_asked_ = false;               // its answer is waited for
  std::optional<program_frame> answer_; // to that one, the first
  std::string objection_;
};

} // namespace sofof
