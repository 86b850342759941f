// A program that is there again when it has died.
#pragma once

#include "base/process/framed_program.hpp"
#include "base/time.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sofof {

/// What is kept, and how patient its keeper is.
struct kept_setup {
  child_setup how;
  std::string configuration;   ///< Lines KEY=VALUE,
  std::string activation;      ///< and those with each `activate`.
  std::size_t most_octets = 0; ///< Of a result.
  /// On the wall clock: a program that is not ready, or does not answer, for
  /// longer is ended. Both > 0.
  std::chrono::milliseconds start_limit{10'000};
  std::chrono::milliseconds answer_limit{1'000};
  /// In the run's time: so long after its death a program is started again,
  /// twice as long after the next one, unless it has given a result or lived
  /// for longer than that before.
  duration first_pause = std::chrono::milliseconds{500};
  duration longest_pause = std::chrono::seconds{10};
  /// Whether an input waits for a program that is not ready yet; else there is
  /// no result until it is.
  bool waits_for_start = false;
  /// @returns one that has been started already, if there is one; else it is
  /// started when it is needed. May be empty.
  std::function<std::unique_ptr<framed_program>()> take_started{};
};

/// Starts a program as it is kept.
/// @throws input_error when the system refuses that.
std::unique_ptr<framed_program> start_program(const kept_setup& setup);

/// Whether a program is there, as it changes.
struct program_news {
  bool is_there = false;
  std::string why; ///< It is not: what it did, in words.
};

/// Keeps one program through its life cycle: configured, active or not, shut
/// down. Times are the run's, and never less than before.
class kept_program {
public:
  /// @param on_news  When it has died, and when it is ready again.
  kept_program(kept_setup setup, std::function<void(program_news)> on_news);

  /// Kills it.
  ~kept_program() = default;

  kept_program(const kept_program&) = delete;
  kept_program& operator=(const kept_program&) = delete;

  void configure(time_point now); ///< Starts it.
  void activate(time_point now);
  void deactivate(time_point now);
  void shut_down(time_point now); ///< Ends it for good.

  /// Finds out whether it still lives, and starts it again if it is time; at
  /// once.
  void look(time_point now);

  /// @returns its result; nullopt if it has none, or is not there.
  std::optional<std::vector<std::byte>>
  exchange(time_point now, std::span<const std::byte> input);

  /// @returns the process; nullopt: none runs.
  std::optional<pid_t> id() const;

private:
  void start(time_point now);
  bool is_up(time_point now, framed_program::clock::time_point until);
  void note_death(time_point now);
  void lose(time_point now, std::string why);

  kept_setup setup_;
  std::function<void(program_news)> on_news_;
  std::unique_ptr<framed_program> runs_; // null: none does
  framed_program::clock::time_point ready_by_;
  bool is_kept_ = false; // between `configure` and `shut_down`
  bool is_active_ = false;
  bool is_missed_ = false; // it has died, and is not ready again
  bool is_ready_ = false;
  time_point ready_at_;
  time_point again_at_;
  duration pause_;
  std::uint64_t inputs_ = 0;
};

} // namespace sofof
