// Work that several hands take from one list.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace sofof {

/// Jobs for several threads. Whoever cannot finish a job hands it back, and
/// somebody else gets it.
template <class Job>
class job_list {
public:
  explicit job_list(std::deque<Job> jobs) : waiting_{std::move(jobs)} {}

  /// Waits while there is nothing to do but somebody may hand a job back.
  /// @returns nullopt once everything is done, or after `stop`.
  std::optional<Job> take() {
    std::unique_lock lock{mutex_};
    changed_.wait(lock, [this] {
      return stopped_ || !waiting_.empty() || at_work_ == 0;
    });
    if (stopped_ || waiting_.empty())
      return std::nullopt;
    auto job = std::move(waiting_.front());
    waiting_.pop_front();
    ++at_work_;
    return job;
  }

  void done() {
    const std::lock_guard lock{mutex_};
    --at_work_;
    changed_.notify_all();
  }

  void hand_back(Job job) {
    const std::lock_guard lock{mutex_};
    --at_work_;
    waiting_.push_front(std::move(job));
    changed_.notify_all();
  }

  /// Nobody gets another job.
  void stop() {
    const std::lock_guard lock{mutex_};
    stopped_ = true;
    changed_.notify_all();
  }

  std::size_t at_work() const {
    const std::lock_guard lock{mutex_};
    return at_work_;
  }

  /// @returns how many are left that nobody has taken.
  std::size_t waiting() const {
    const std::lock_guard lock{mutex_};
    return waiting_.size();
  }

private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> waiting_;
  std::size_t at_work_ = 0;
  bool stopped_ = false;
};

} // namespace sofof
