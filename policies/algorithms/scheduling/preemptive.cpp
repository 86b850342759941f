// The window in which the core has nothing else to do is counted through.
#include "policies/algorithms/scheduling/preemptive.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <numeric>

namespace sofof::policies {

namespace {

constexpr duration longest_busy = std::chrono::seconds{60};
constexpr double least_rest = 1e-9; // of a core
constexpr duration moment{1};

bool has_rest(std::span<const periodic_task> tasks) {
  return utilisation(tasks) <= 1 - least_rest;
}

/// @returns the most releases of a function until `last`, that moment included.
duration::rep releases_until(const periodic_task& task, duration last) {
  return last < duration{0} ? 0 : (last + task.jitter) / task.period + 1;
}

/// @returns the most releases before `end`.
duration::rep releases_before(const periodic_task& task, duration end) {
  return releases_until(task, end - moment);
}

/// @returns the least window that is as long as the work within it.
/// @param work  Of a window of this length; it never falls.
template <class Work>
std::optional<duration> least_window(duration first, Work work) {
  for (auto window = first; window <= longest_busy;) {
    const auto needed = work(window);
    if (needed <= window)
      return window;
    window = needed;
  }
  return std::nullopt;
}

/// @param before  Those that are more urgent.
std::optional<duration>
response_by_priority(std::span<const periodic_task> before,
                     const periodic_task& own) {
  if (!has_rest(before))
    return std::nullopt;
  return least_window(std::max(own.wcet, moment), [&](duration window) {
    auto work = own.wcet;
    for (const auto& other : before)
      work += releases_before(other, window) * other.wcet;
    return work;
  });
}

/// One core, by deadlines, for one of its functions.
class deadline_windows {
public:
  /// @param longest  No window is longer.
  deadline_windows(std::span<const periodic_task> tasks, std::size_t own,
                   duration longest)
      : tasks_{tasks}, own_{tasks[own]}, longest_{longest} {
    // Those of whose jobs the last comes first.
    for (const auto& task : tasks)
      by_last_.push_back(&task);
    std::ranges::stable_sort(by_last_, std::ranges::greater{},
                             &periodic_task::deadline);
  }

  /// Between two moments each bound falls, or only rises.
  std::optional<duration> response() const {
    auto longest = own_.wcet;
    std::optional<duration> counted, in_turn; // at the moment before
    for (const auto a : moments()) {
      const auto window = counted_window(a);
      if (!window)
        return std::nullopt;
      const auto now_counted = *window - a;
      const auto now_in_turn = in_turn_window(a) - a;
      longest = std::max(
          longest,
          std::min(std::max(counted.value_or(now_counted), now_counted),
                   std::max(in_turn.value_or(now_in_turn), now_in_turn)));
      counted = now_counted;
      in_turn = now_in_turn;
    }
    return longest;
  }

private:
  // @returns until when jobs of a function count, `a` being the own one's
  // release: those that come then are due with it.
  duration last(const periodic_task& task, duration a) const {
    return a + own_.deadline - task.deadline;
  }

  // @returns all that is released within the window and due by its own.
  std::optional<duration> counted_window(duration a) const {
    return least_window(moment, [&](duration window) {
      duration work{0};
      for (const auto& task : tasks_)
        work += (&task == &own_ ? releases_until(task, a)
                                : std::min(releases_before(task, window),
                                           releases_until(task, last(task, a))))
                * task.wcet;
      return work;
    });
  }

  // What jobs come one after the other for: all but the last of a function are
  // done when that is released.
  struct turns {
    duration last_ones{0};
    duration earlier{0};      // all that is counted,
    duration after_window{0}; // and what fits: so much more than `a`
    duration done{0};         // the less of both
  };

  turns turns_at(duration a) const {
    turns all{.after_window = longest_};
    for (const auto* task : by_last_) {
      const auto until = last(*task, a);
      if (until < duration{0})
        continue;
      const auto before = (releases_until(*task, until) - 1) * task->wcet;
      all.last_ones += task->wcet;
      all.earlier += before;
      all.after_window = std::min(all.after_window + before, until - a);
      all.done = std::min(all.done + before, until);
    }
    return all;
  }

  duration in_turn_window(duration a) const {
    const auto all = turns_at(a);
    return all.last_ones + all.done;
  }

  // @returns where the response may be longest: where a count steps up, or
  // where all that is counted fits for the first time.
  std::vector<duration> moments() const {
    std::vector<duration> all{duration{0}, longest_};
    for (const auto& task : tasks_) {
      const auto first = task.deadline - own_.deadline;
      if (first > duration{0} && first < longest_)
        all.push_back(first);
      for (auto a = first - task.jitter; a < longest_; a += task.period)
        if (a > duration{0} && a > first)
          all.push_back(a);
    }
    std::ranges::sort(all);
    const auto steps = all.size();
    for (std::size_t k = 0; k < steps; ++k) {
      const auto there = turns_at(all[k]);
      if (const auto a = there.earlier - there.after_window;
          a > all[k] && a < longest_)
        all.push_back(a);
    }
    std::ranges::sort(all);
    const auto repeated = std::ranges::unique(all);
    all.erase(repeated.begin(), repeated.end());
    return all;
  }

  std::span<const periodic_task> tasks_;
  const periodic_task& own_;
  std::vector<const periodic_task*> by_last_;
  duration longest_;
};

std::optional<duration> longest_window(std::span<const periodic_task> tasks) {
  if (!has_rest(tasks))
    return std::nullopt;
  return least_window(moment, [&](duration window) {
    duration work{0};
    for (const auto& task : tasks)
      work += releases_before(task, window) * task.wcet;
    return work;
  });
}

} // namespace

std::vector<std::optional<duration>>
preemptive_responses(std::span<const periodic_task> tasks, core_order order) {
  std::vector<std::optional<duration>> all(tasks.size());
  if (order == core_order::fixed_priority) {
    for (std::size_t i = 0; i < tasks.size(); ++i)
      all[i] = response_by_priority(tasks.first(i), tasks[i]);
  } else if (const auto longest = longest_window(tasks)) {
    for (std::size_t i = 0; i < tasks.size(); ++i)
      all[i] = deadline_windows{tasks, i, *longest}.response();
  }
  return all;
}

std::vector<std::size_t> share_out(std::span<const periodic_task> tasks,
                                   std::size_t cores) {
  assert(cores > 0);
  std::vector<std::size_t> by_load(tasks.size());
  std::iota(by_load.begin(), by_load.end(), std::size_t{0});
  const auto load_of = [&](std::size_t i) {
    return utilisation(tasks.subspan(i, 1));
  };
  std::ranges::stable_sort(by_load, std::ranges::greater{}, load_of);
  std::vector<double> loads(cores);
  std::vector<std::size_t> all(tasks.size());
  for (const auto i : by_load) {
    const auto least = std::ranges::min_element(loads);
    *least += load_of(i);
    all[i] = static_cast<std::size_t>(least - loads.begin());
  }
  return all;
}

} // namespace sofof::policies
