// A thread that asks a registry now and then.
#pragma once

#include "base/time.hpp"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace sofof::network::mec011 {

/// When something is done again.
struct pause_between {
  duration at_most{};
  duration at_least{}; ///< If somebody is in a hurry.
};

/// Does something at once, and again after each pause.
class repeating_thread {
public:
  /// @param step    Called on the thread; must not throw.
  /// @param at_end  Called there once nothing is to be repeated.
  explicit repeating_thread(
      std::function<pause_between()> step,
      std::function<void()> at_end = [] {});
  /// As `stop`.
  ~repeating_thread();
  repeating_thread(const repeating_thread&) = delete;
  repeating_thread& operator=(const repeating_thread&) = delete;

  /// The pause is as short as may be. Any thread may call this.
  void hurry();

  /// Ends it, and does not wait. Any thread may call this.
  void end();

  /// Ends it, and waits for that; for the owner.
  void stop();

private:
  void run();

  const std::function<pause_between()> step_;
  const std::function<void()> at_end_;
  std::mutex mutex_; // guards
  bool is_in_a_hurry_ = false;
  bool ends_ = false;
  std::condition_variable changed_;
  std::thread thread_;
};

} // namespace sofof::network::mec011
