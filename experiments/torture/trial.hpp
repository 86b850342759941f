// One run in a process of its own, so that whatever happens in it ends nothing
// else.
#pragma once

#include "experiments/torture/promises.hpp"
#include "experiments/torture/tally.hpp"
#include "experiments/torture/tried_scenario.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>

namespace sofof::experiments::torture {

/// What became of a run.
struct verdict {
  tally counts;
  broken_promises broken;

  bool is_good() const { return broken.empty(); }
};

/// @returns a verdict as text, and back.
/// @{
std::string text_of(const verdict& v);
std::optional<verdict> parse_verdict(std::string_view text);
/// @}

/// Runs a scenario in virtual time and checks its results, in this process.
/// @param folder  Where results go; a new one.
/// @throws input_error for a scenario that cannot be loaded.
verdict try_here(const tried_scenario& what,
                 const std::filesystem::path& folder);

/// A run in a child process, which says its verdict through a pipe.
class trial {
public:
  /// Begins. Precondition: this process has one thread.
  /// @param folder  Of this trial alone; gone when it is over.
  trial(const tried_scenario& what, std::filesystem::path folder);
  trial(const trial&) = delete;
  trial& operator=(const trial&) = delete;
  ~trial(); ///< Kills it if it is not over.

  /// To be polled: it has something to say.
  int pipe() const { return pipe_; }

  /// Waits until the child has written something, or has ended.
  /// @returns what became of it; nullopt while it goes on. A run that dies,
  /// needs too much time, or throws breaks the promise "it_ends".
  std::optional<verdict> poll_verdict();

  /// Moves the run's results, as far as there are any, out of the folder.
  void keep_results(const std::filesystem::path& at) const;

private:
  verdict end();

  std::filesystem::path folder_;
  int pipe_ = -1;
  pid_t child_ = -1;
  std::string said_;
};

/// Runs it in a child process, and waits.
/// @param kept  Gets the run's results, in place of what it had; empty: they
///              are not kept.
verdict try_apart(const tried_scenario& what,
                  const std::filesystem::path& folder,
                  const std::filesystem::path& kept = {});

} // namespace sofof::experiments::torture
