// What is computed by whichever thread has time, until somebody needs it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace sofof {

/// Something to be computed once, by one thread.
class job {
public:
  /// @param what  Depends on nothing that others change meanwhile.
  explicit job(std::function<void()> what) : what_{std::move(what)} {}

  /// Computes it, unless that has begun.
  void run();

  /// Returns when it has been computed; by this thread, if it has not begun.
  /// @throws what it threw.
  void wait();

private:
  enum class state { waits, runs, done };

  std::function<void()> what_;
  std::exception_ptr thrown_;
  std::atomic<state> state_ = state::waits;
};

using job_ptr = std::shared_ptr<job>;

/// Threads that help whoever has jobs. That nobody helps changes nothing but
/// the time that it takes.
class job_pool {
public:
  /// @param helpers  Threads besides the caller's; fewer, if the machine does
  ///                 not give so many. With 0 `begin` computes the job.
  explicit job_pool(std::size_t helpers);

  /// Jobs that no helper has begun are left to those who wait for them.
  virtual ~job_pool();

  job_pool(const job_pool&) = delete;
  job_pool& operator=(const job_pool&) = delete;

  /// Whether jobs may be computed by other threads.
  virtual bool has_helpers() const { return !helpers_.empty(); }

  /// The job may be computed from now on.
  virtual void begin(job_ptr what);

private:
  void help();

  std::mutex mutex_;
  std::condition_variable more_;
  std::deque<job_ptr> waiting_;
  bool ends_ = false;
  std::vector<std::thread> helpers_;
};

} // namespace sofof
