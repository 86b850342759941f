// Points become jobs, threads make their runs, summaries become a table.
#include "scenario/sweep/sweep.hpp"

#include "scenario/input_error.hpp"
#include "scenario/load.hpp"
#include "scenario/output_file.hpp"
#include "scenario/placement.hpp"
#include "scenario/stopwatch.hpp"
#include "scenario/sweep/point_table.hpp"
#include "scenario/sweep/run_store.hpp"
#include "scenario/toml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <ostream>
#include <set>
#include <system_error>
#include <thread>

namespace sofof {

namespace {

/// One run that is wanted, by one point or by several.
struct job {
  std::string run;
  std::size_t point = 0; ///< The first that wants it.
  double cost = 0;       ///< About proportional to its computing time.
};

/// Vehicle cycles, and something for making a world.
double cost_of(const scenario& s) {
  constexpr double setup = 1000;
  auto cycles = setup;
  const auto vehicles = static_cast<double>(place_vehicles(s).size());
  for (const auto& kind : s.services)
    cycles += vehicles * to_seconds(s.length) / to_seconds(kind->common.period);
  return cycles;
}

/// A sweep at work: shared by the threads that make runs and the console's.
class sweep_at_work {
public:
  sweep_at_work(const sweep_plan& plan, const sweep_options& options,
                const std::atomic<bool>& interrupted, std::ostream& console)
      : plan_{plan}, options_{options},
        interrupted_{interrupted}, console_{console}, points_{points_of(plan)},
        results_(points_.size()), errors_(points_.size()) {
    load_all();
    store_.emplace(options.out);
    std::error_code ignored; // an old one may be of other points
    std::filesystem::remove(table(), ignored);
  }

  sweep_outcome carry_out() {
    waiting_ = wanted();
    run_all();
    if (interrupted_) {
      sweep_outcome cut_short;
      cut_short.interrupted = true;
      return cut_short;
    }
    return finish();
  }

private:
  scenario load(std::size_t point) const {
    return load_scenario(plan_.scenario, points_[point].given);
  }

  std::filesystem::path table() const {
    return options_.out / (plan_.name + ".csv");
  }

  /// Names all runs, while nothing has been touched.
  void load_all() {
    const auto base = read_text(plan_.scenario).value_or("");
    for (std::size_t i = 0; i < points_.size() && !interrupted_; ++i) {
      check_given_once(plan_, points_[i], base);
      try {
        const auto s = load(i);
        results_[i].run = name_of_run(s, options_.program);
        costs_.try_emplace(results_[i].run, cost_of(s));
      } catch (const std::exception& problem) {
        report(i, problem.what());
      }
    }
    refuse_if_none_can_be_loaded();
  }

  /// @returns what is not finished, the longest first, so that the last ones
  /// to run are short.
  std::deque<job> wanted() {
    std::deque<job> jobs;
    std::set<std::string> met;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto& run = results_[i].run;
      if (run.empty() || !met.insert(run).second)
        continue;
      if (store_->summary_of(run))
        ++found_;
      else
        jobs.push_back({run, i, costs_.at(run)});
    }
    std::ranges::stable_sort(jobs, std::ranges::greater{}, &job::cost);
    for (const auto& one : jobs)
      cost_ += one.cost;
    all_ = jobs.size();
    return jobs;
  }

  /// The mistake is none of a point then, but of the file.
  void refuse_if_none_can_be_loaded() const {
    if (std::ranges::none_of(errors_, &std::string::empty))
      throw input_error{fmt::format(
          "none of {} points can be run; {} because: {}", points_.size(),
          describe(plan_, points_.front()), errors_.front())};
  }

  void run_all() {
    progress shown{console_, options_.show};
    const stopwatch watch;
    std::vector<std::thread> threads;
    const auto useful = std::min<std::size_t>(options_.jobs, waiting_.size());
    working_ = useful;
    for (std::size_t i = 0; i < useful; ++i)
      threads.emplace_back([this] { work(); });
    std::unique_lock lock{mutex_};
    for (;;) {
      tell_news(shown);
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
  }

  /// One thread: makes runs until there are no more.
  void work() {
    std::unique_lock lock{mutex_};
    while (!waiting_.empty() && !interrupted_) {
      const auto next = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      auto why = failure_of(next);
      lock.lock();
      if (why)
        report(next.point, *why);
      ++done_;
      cost_done_ += next.cost;
    }
    --working_;
    changed_.notify_all();
  }

  /// Makes a run.
  /// @returns why there is no result; nullopt if there is one.
  std::optional<std::string> failure_of(const job& one) const {
    try {
      options_.make(load(one.point), store_->folder_of(one.run), interrupted_);
      return std::nullopt;
    } catch (const std::exception& problem) {
      return problem.what();
    }
  }

  void report(std::size_t point, const std::string& why) {
    errors_[point] = why;
    news_.push_back(fmt::format("point {} ({}) failed: {}", point + 1,
                                describe(plan_, points_[point]), why));
  }

  void tell_news(progress& shown) {
    if (news_.empty())
      return;
    shown.clear();
    for (const auto& line : news_)
      console_ << line << '\n';
    console_.flush();
    news_.clear();
  }

  std::string line(double wall_s) const {
    auto text = fmt::format("{}{} of {} runs", options_.title, found_ + done_,
                            found_ + all_);
    if (found_ > 0)
      text += fmt::format(" ({} from before)", found_);
    text += fmt::format("  {} at work", working_);
    if (cost_done_ > 0)
      text += fmt::format(
          "  ETA {}", for_people(wall_s * (cost_ - cost_done_) / cost_done_));
    return text;
  }

  sweep_outcome finish() {
    sweep_outcome outcome;
    for (std::size_t i = 0; i < results_.size(); ++i) {
      auto& result = results_[i];
      result.summary = store_->summary_of(result.run).value_or("");
      outcome.folders.push_back(result.failed()
                                    ? std::filesystem::path{}
                                    : store_->folder_of(result.run));
      if (result.failed())
        ++outcome.failed;
      else
        ++(result.safe() ? outcome.good : outcome.unsafe);
    }
    outcome.table = table();
    write_file(outcome.table, point_table(plan_, results_));
    return outcome;
  }

  const sweep_plan& plan_;
  const sweep_options& options_;
  const std::atomic<bool>& interrupted_;
  std::ostream& console_;
  std::optional<run_store> store_;      ///< Once all points are known.
  std::map<std::string, double> costs_; ///< Of runs by their names.
  std::vector<sweep_point> points_;
  std::vector<point_result> results_;
  std::vector<std::string> errors_;

  std::mutex mutex_; ///< Of all below, while threads make runs.
  std::condition_variable changed_;
  std::deque<job> waiting_;
  std::vector<std::string> news_;
  std::size_t working_ = 0; ///< Threads.
  std::size_t found_ = 0, all_ = 0, done_ = 0;
  double cost_ = 0, cost_done_ = 0;
};

} // namespace

sweep_outcome sweep(const sweep_plan& plan, const sweep_options& options,
                    const std::atomic<bool>& interrupted,
                    std::ostream& console) {
  return sweep_at_work{plan, options, interrupted, console}.carry_out();
}

} // namespace sofof
