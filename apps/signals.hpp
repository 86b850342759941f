// Ctrl-C and SIGTERM.
#pragma once

#include <atomic>
#include <csignal>

namespace sofof {

/// Set by the first of these signals, which shall end the run in good order; a
/// second one ends it at once.
inline std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

inline void catch_signals() {
  const auto on_signal = [](int signal) {
    interrupted = true;
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

} // namespace sofof
