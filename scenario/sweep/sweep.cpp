// Points become jobs, sites carry them out, summaries become a table.
#include "scenario/sweep/sweep.hpp"

#include "scenario/input_error.hpp"
#include "scenario/load.hpp"
#include "scenario/output_file.hpp"
#include "scenario/placement.hpp"
#include "scenario/stopwatch.hpp"
#include "scenario/sweep/job_list.hpp"
#include "scenario/sweep/point_table.hpp"
#include "scenario/sweep/run_store.hpp"
#include "scenario/toml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
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

/// A sweep at work: shared by the threads of its sites and the console's.
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
    job_list<job> jobs{wanted()};
    run_all(jobs);
    if (interrupted_) {
      sweep_outcome cut_short;
      cut_short.interrupted = true;
      return cut_short;
    }
    if (jobs.waiting() > 0)
      throw std::runtime_error{
          fmt::format("no site is left for {} runs: {}; the "
                      "same command goes on later.",
                      jobs.waiting(), last_loss_)};
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

  void run_all(job_list<job>& jobs) {
    progress shown{console_, options_.show};
    const stopwatch watch;
    std::vector<std::thread> hands;
    at_site_.resize(options_.sites.size());
    double last_there_s = 0;
    std::unique_lock lock{mutex_};
    for (;;) {
      if (interrupted_)
        jobs.stop();
      else
        hire(jobs, hands);
      hear_news();
      tell_news(shown);
      const auto wall_s = watch.elapsed_s();
      if (working_ > 0)
        last_there_s = wall_s;
      else if (interrupted_ || jobs.waiting() == 0
               || wall_s - last_there_s >= to_seconds(options_.patience))
        break;
      shown.show([&] { return line(jobs, wall_s); }, wall_s);
      constexpr std::chrono::milliseconds look_period{100};
      changed_.wait_for(lock, look_period);
    }
    shown.clear();
    tell_news(shown);
    lock.unlock();
    for (auto& hand : hands)
      hand.join();
  }

  /// Sites come and go: as many hands for each as it has slots now.
  void hire(job_list<job>& jobs, std::vector<std::thread>& hands) {
    for (std::size_t i = 0; i < at_site_.size(); ++i)
      while (jobs.waiting() > 0 && at_site_[i] < options_.sites[i]->slots()) {
        ++at_site_[i];
        ++working_;
        hands.emplace_back([this, &jobs, i] { work(jobs, i); });
      }
  }

  void work(job_list<job>& jobs, std::size_t site) {
    while (auto next = jobs.take())
      if (interrupted_) {
        jobs.hand_back(*next);
        break;
      } else if (!try_one(jobs, *options_.sites[site], *next)) {
        break;
      }
    const std::lock_guard lock{mutex_};
    --at_site_[site];
    --working_;
    changed_.notify_all();
  }

  /// @returns whether the site is still there.
  bool try_one(job_list<job>& jobs, run_site& site, const job& one) {
    try {
      site.carry_out(load(one.point), store_->folder_of(one.run), interrupted_);
    } catch (const site_lost& loss) {
      jobs.hand_back(one);
      const std::lock_guard lock{mutex_};
      last_loss_ = loss.what();
      news_.push_back(fmt::format("{}; others do its run", loss.what()));
      return false;
    } catch (const std::exception& problem) {
      const std::lock_guard lock{mutex_};
      report(one.point, problem.what());
    }
    jobs.done();
    const std::lock_guard lock{mutex_};
    ++done_;
    cost_done_ += one.cost;
    return true;
  }

  void report(std::size_t point, const std::string& why) {
    errors_[point] = why;
    news_.push_back(fmt::format("point {} ({}) failed: {}", point + 1,
                                describe(plan_, points_[point]), why));
  }

  void hear_news() {
    for (const auto& site : options_.sites)
      for (auto& line : site->news()) {
        if (site->slots() == 0)
          last_loss_ = line;
        news_.push_back(std::move(line));
      }
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

  std::string line(const job_list<job>& jobs, double wall_s) const {
    auto text = fmt::format("{}{} of {} runs", options_.title, found_ + done_,
                            found_ + all_);
    if (found_ > 0)
      text += fmt::format(" ({} from before)", found_);
    text += fmt::format("  {} at work", jobs.at_work());
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

  std::mutex mutex_; ///< Of all below, while sites are at work.
  std::condition_variable changed_;
  std::vector<std::string> news_;
  std::string last_loss_;
  std::vector<std::size_t> at_site_; ///< Hands of each.
  std::size_t working_ = 0;          ///< All hands.
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
