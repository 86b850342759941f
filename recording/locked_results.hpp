// The results of a run as the recorder sees them: shared with the console,
// and never a reason to crash.
#pragma once

#include "base/input_error.hpp"
#include "recording/results.hpp"
#include "recording/write_failure.hpp"

#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace sofof::recording {

/// Guards `results` for two threads, the recorder's and the console's. What
/// goes wrong is thrown again to the console's, but for files that may end.
class locked_results final : public messages::record_sink {
public:
  /// @param on_failure  What to do about a failure after this call.
  /// @throws input_error when the files cannot be made.
  locked_results(std::filesystem::path folder, run_info run,
                 write_failure on_failure = write_failure::ends_the_run)
      : on_failure_{on_failure}, results_{std::move(folder), std::move(run)} {}
  /// Without files from the beginning.
  /// @param why  They cannot be written.
  locked_results(run_info run, std::string why)
      : on_failure_{write_failure::ends_the_files}, results_{std::move(run)},
        loss_{std::move(why)} {}

  void on_record(const messages::record& x) override;

  /// Calls `use(results&)` while nobody else does; twice if files that may end
  /// cannot be written.
  /// @throws what went wrong with a record before.
  template <class Use>
  auto with(Use use) {
    const std::lock_guard lock{mutex_};
    if (failure_)
      std::rethrow_exception(failure_);
    return survive(use);
  }

  /// @returns why files are no longer written; nullopt while they are.
  std::optional<std::string> loss() const {
    const std::lock_guard lock{mutex_};
    return loss_;
  }

  /// Something else went wrong; the first failure counts.
  void fail(const std::string& why) {
    const std::lock_guard lock{mutex_};
    if (!failure_)
      failure_ = std::make_exception_ptr(std::runtime_error{why});
  }

private:
  template <class Use>
  auto survive(Use use) {
    try {
      return use(results_);
    } catch (const input_error& problem) {
      if (on_failure_ == write_failure::ends_the_run)
        throw;
      loss_ = problem.what();
    }
    results_.close_files();
    return use(results_);
  }

  mutable std::mutex mutex_;
  const write_failure on_failure_;
  results results_;
  std::optional<std::string> loss_;
  std::exception_ptr failure_;
};

inline void locked_results::on_record(const messages::record& x) {
  const std::lock_guard lock{mutex_};
  if (failure_)
    return;
  try {
    survive([&x](results& r) { r.on_record(x); });
  } catch (...) {
    failure_ = std::current_exception();
  }
}

} // namespace sofof::recording
