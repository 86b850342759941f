// One process of several that run a scenario together.
#pragma once

#include "base/process/child.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments {

/// A process whose lines are kept in a file and can be waited for.
class member {
public:
  /// @param log      What it says, line by line.
  /// @param on_line  Called for each line, without its end; may be empty.
  /// @throws input_error when it cannot be started.
  member(std::string name, std::vector<std::string> command,
         const std::filesystem::path& log,
         std::function<void(std::string_view)> on_line = {});

  const std::string& name() const { return name_; }
  int socket() const { return child_.socket(); }
  /// @returns whether nothing will come from it any more.
  bool is_silent() const { return is_silent_; }

  /// Reads what it has said, without waiting.
  void read();

  /// @returns what follows `begin` up to a blank, a semicolon or the line's
  /// end, in the first line that contains it; nothing if none does so far.
  std::optional<std::string> word_behind(std::string_view begin) const;

  /// @returns its last line.
  std::string last_line() const;

  std::optional<child_end> poll_end() { return child_.poll_end(); }

  /// Asks it to end in good order.
  void interrupt();

  /// Waits until it has ended, reading what it says; kills it after this time.
  child_end wait_for_end(std::chrono::seconds patience);

private:
  void end_line();

  std::string name_;
  child child_;
  std::ofstream log_;
  std::function<void(std::string_view)> on_line_;
  std::string line_;
  std::vector<std::string> lines_;
  bool is_silent_ = false;
};

} // namespace sofof::experiments
