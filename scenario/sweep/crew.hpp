// The hands of a worker.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace sofof {

/// A run that somebody ordered, in a folder of its own that goes with the last
/// one who holds it. Any thread may call these.
class run_order {
public:
  /// @throws std::filesystem::filesystem_error when the folder cannot be made.
  explicit run_order(std::filesystem::path folder);
  run_order(const run_order&) = delete;
  run_order& operator=(const run_order&) = delete;
  ~run_order();

  /// Where the files that were sent lie, config.toml among them.
  std::filesystem::path given() const { return folder_ / "given"; }
  std::filesystem::path results() const { return folder_ / "results"; }

  /// Once true, the run ends soon.
  std::atomic<bool> interrupted = false;

  /// It has ended by itself.
  /// @param failure  Why there is no result; empty if there is one.
  void end(std::string failure);
  /// @returns the failure, or an empty one; nullopt while it goes on.
  std::optional<std::string> ended() const;

private:
  std::filesystem::path folder_;
  mutable std::mutex mutex_;
  std::optional<std::string> ended_;
};

/// Carries an order out; throws when it fails, and returns or throws soon once
/// it is interrupted.
using order_runner = std::function<void(const run_order&)>;

/// Threads that carry out orders, in the order they came.
class crew {
public:
  crew(std::size_t hands, order_runner run);
  crew(const crew&) = delete;
  crew& operator=(const crew&) = delete;
  ~crew() { stop(); }

  /// @param on_end  Called once it has ended, unless it is interrupted.
  void add(std::shared_ptr<run_order> order, std::function<void()> on_end);

  /// Interrupts what is at work, forgets what waits, and returns when nobody is
  /// at work. Nothing begins after that.
  void stop();

private:
  struct job {
    std::shared_ptr<run_order> order;
    std::function<void()> on_end;
  };

  void work();
  void carry_out(const job& next) const;

  const order_runner run_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<job> waiting_;
  std::set<run_order*> at_work_;
  bool stops_ = false;
  std::vector<std::thread> hands_;
};

} // namespace sofof
