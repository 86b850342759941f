// The results of a run as the recorder sees them: shared with the console,
// and never a reason to crash.
#pragma once

#include "scenario/results.hpp"

#include <exception>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace sofof {

/// Guards `results` for two threads, the recorder's and the console's. What
/// goes wrong while writing is thrown again to the console's.
class record_keeper final : public record_sink {
public:
  record_keeper(std::filesystem::path folder, run_info run)
      : results_{std::move(folder), std::move(run)} {}

  void take(const event_record& x) override { keep(x); }
  void take(const decision_record& x) override { keep(x); }
  void take(const cycle_record& x) override { keep(x); }
  void take(const episode_record& x) override { keep(x); }
  void take(const track_record& x) override { keep(x); }
  void take(const safety_record& x) override { keep(x); }
  void take(const collision_record& x) override { keep(x); }
  void take(const drive_record& x) override { keep(x); }
  void take(const plan_switch_record& x) override { keep(x); }
  void take(const air_record& x) override { keep(x); }

  /// Calls `use(results&)` while nobody else does.
  /// @throws what went wrong in a `take` before.
  template <class Use>
  auto with(Use use) {
    const std::lock_guard lock{mutex_};
    if (failure_)
      std::rethrow_exception(failure_);
    return use(results_);
  }

  /// Something else went wrong; the first failure counts.
  void fail(const std::string& why) {
    const std::lock_guard lock{mutex_};
    if (!failure_)
      failure_ = std::make_exception_ptr(std::runtime_error{why});
  }

private:
  template <class Record>
  void keep(const Record& x) {
    const std::lock_guard lock{mutex_};
    if (failure_)
      return;
    try {
      results_.take(x);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  std::mutex mutex_;
  results results_;
  std::exception_ptr failure_;
};

} // namespace sofof
