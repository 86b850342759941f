// Ctrl-C, SIGTERM and SIGHUP.
#pragma once

#include <atomic>
#include <csignal>

namespace sofof::apps {

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

/// Set by SIGHUP: keys shall be read again.
inline std::atomic<bool> keys_have_changed{false};

/// Without this call SIGHUP ends the process.
inline void catch_hang_up() {
  std::signal(SIGHUP, [](int) { keys_have_changed = true; });
}

} // namespace sofof::apps
