// Threads take runs from one list, the caller's thread tells of them.
#include "experiments/sweep/make_runs.hpp"

#include "base/stopwatch.hpp"
#include "experiments/sweep/point_table.hpp"
#include "scenario/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <ostream>
#include <thread>
#include <utility>

namespace sofof::experiments {

namespace {

class runs_at_work {
public:
  runs_at_work(std::vector<wanted_run> runs, const run_store& store,
               const making& how, const std::atomic<bool>& interrupted,
               std::ostream& console)
      : store_{store}, how_{how}, interrupted_{interrupted}, console_{console} {
    all_ = runs.size();
    std::erase_if(runs, [&](const wanted_run& run) {
      return store_.summary_of(run.name).has_value();
    });
    found_ = all_ - runs.size();
    if (how_.watched) {
      how_.watched->runs += all_;
      how_.watched->found += found_;
    }
    std::ranges::stable_sort(runs, std::ranges::greater{}, &wanted_run::cost);
    for (auto& run : runs) {
      cost_ += run.cost;
      waiting_.push_back(std::move(run));
    }
  }

  /// @returns how many the store had before.
  std::size_t make_all() {
    recording::progress shown{console_, how_.show};
    const stopwatch watch;
    std::vector<std::thread> threads;
    working_ = std::min<std::size_t>(how_.jobs, waiting_.size());
    for (auto i = working_; i > 0; --i)
      threads.emplace_back([this] { work(); });
    std::unique_lock lock{mutex_};
    for (;;) {
      tell_failures(shown);
      if (working_ == 0)
        break;
      const auto wall_s = watch.elapsed_s();
      shown.show([&] { return line(wall_s); }, wall_s);
      constexpr std::chrono::milliseconds look_period{100};
      changed_.wait_for(lock, look_period);
    }
    shown.clear();
    lock.unlock();
    for (auto& thread : threads)
      thread.join();
    return found_;
  }

private:
  /// One thread: makes runs until there are no more.
  void work() {
    std::unique_lock lock{mutex_};
    while (!waiting_.empty() && !interrupted_) {
      const auto next = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      const auto why = failure_of(next);
      if (how_.watched)
        count(next);
      lock.lock();
      if (why)
        failures_.push_back(fmt::format("{} failed: {}", next.point, *why));
      ++done_;
      cost_done_ += next.cost;
    }
    --working_;
    changed_.notify_all();
  }

  /// Makes a run, unless another process has made it meanwhile.
  /// @returns why there is no result; nullopt if there is one.
  std::optional<std::string> failure_of(const wanted_run& run) const {
    try {
      if (!store_.summary_of(run.name))
        store_.add(run.name, [&](const auto& folder) {
          how_.make(scenario::load_scenario(run.scenario, run.given), folder,
                    interrupted_);
        });
      return std::nullopt;
    } catch (const std::exception& problem) {
      return problem.what();
    }
  }

  void count(const wanted_run& run) const {
    const auto summary = store_.summary_of(run.name);
    if (!summary && interrupted_)
      return;
    run_counts one;
    one.add({run.name, summary.value_or("")});
    auto& to = *how_.watched;
    to.good += one.good;
    to.unsafe += one.unsafe;
    to.failed += one.failed;
  }

  void tell_failures(recording::progress& shown) {
    if (failures_.empty())
      return;
    shown.clear();
    for (const auto& failure : failures_)
      console_ << failure << '\n';
    console_.flush();
    failures_.clear();
  }

  std::string line(double wall_s) const {
    auto text =
        fmt::format("{}{} of {} runs", how_.title, found_ + done_, all_);
    if (found_ > 0)
      text += fmt::format(" ({} from before)", found_);
    text += fmt::format("  {} at work", working_);
    if (cost_done_ > 0)
      text += fmt::format(
          "  ETA {}",
          recording::for_people(wall_s * (cost_ - cost_done_) / cost_done_));
    return text;
  }

  const run_store& store_;
  const making& how_;
  const std::atomic<bool>& interrupted_;
  std::ostream& console_;
  std::size_t all_ = 0, found_ = 0;
  double cost_ = 0; ///< Of all that are to be made.

  std::mutex mutex_; ///< Of all below, while threads work.
  std::condition_variable changed_;
  std::deque<wanted_run> waiting_;
  std::vector<std::string> failures_;
  std::size_t working_ = 0; ///< Threads.
  std::size_t done_ = 0;
  double cost_done_ = 0;
};

} // namespace

std::size_t make_runs(std::vector<wanted_run> runs, const run_store& store,
                      const making& how, const std::atomic<bool>& interrupted,
                      std::ostream& console) {
  assert(how.jobs >= 1);
  return runs_at_work{std::move(runs), store, how, interrupted, console}
      .make_all();
}

} // namespace sofof::experiments
