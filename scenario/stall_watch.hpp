// Watches whether the machine stands still beneath a run on the wall clock.
#pragma once

#include "recording/run_info.hpp"

#include <mutex>
#include <thread>

namespace sofof::scenario {

/// A thread that sleeps for some milliseconds again and again, and notices when
/// it is woken late: for that long this process did not get a core, whatever
/// else asked for one. Runs as long as it lives.
class stall_watch {
public:
  stall_watch();

  /// @returns the times by which it was late for more than 20 ms.
  recording::standstill so_far() const;

private:
  void look(const std::stop_token& end);

  mutable std::mutex mutex_;
  recording::standstill seen_;
  std::jthread thread_; // last, as it uses the others
};

} // namespace sofof::scenario
