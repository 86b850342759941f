// What goes before a job is counted in the window in which all are busy.
#include "policies/algorithms/scheduling/response_time.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

namespace sofof::policies {

namespace {

constexpr auto longest_window_s = 60.0;
constexpr double least_room = 1e-9; // of a worker
constexpr duration instant{1};

/// @returns the share of one worker that all sessions take.
double load_of(std::span<const session_group> mix) {
  double sum = 0;
  for (const auto& group : mix)
    sum += static_cast<double>(group.count)
           * utilisation(std::span{&group.task, 1});
  return sum;
}

/// @returns the most releases of a session within a closed window.
duration::rep releases(const periodic_task& task, duration window) {
  assert(window >= duration{0});
  return (window + task.jitter) / task.period + 1;
}

/// @returns Σ C (1 + J/T), s: what sessions ask for beyond their load.
double burst_s(std::span<const session_group> mix) {
  double sum = 0;
  for (const auto& [task, count] : mix)
    sum += static_cast<double>(count) * to_seconds(task.wcet)
           * (1 + to_seconds(task.jitter) / to_seconds(task.period));
  return sum;
}

duration longest_job(std::span<const session_group> mix) {
  duration longest{0};
  for (const auto& group : mix)
    longest = std::max(longest, group.task.wcet);
  return longest;
}

/// So many jobs that were under way, and what each adds to the work.
struct carried {
  duration work;
  std::size_t count;
};

/// @returns the greatest sum of `most` of them.
duration greatest(std::vector<carried>& all, std::size_t most) {
  std::ranges::sort(all, std::greater{}, &carried::work);
  duration sum{0};
  for (const auto& [work, count] : all) {
    const auto taken = std::min(most, count);
    sum += work * static_cast<duration::rep>(taken);
    most -= taken;
  }
  return sum;
}

/// The windows of a mix.
class windows {
public:
  windows(std::span<const session_group> mix, queue_order order,
          std::size_t workers)
      : mix_{mix}, order_{order}, workers_{workers}, load_{load_of(mix)},
        room_{static_cast<double>(workers) - load_},
        most_s_{(burst_s(mix)
                 + static_cast<double>(workers) * to_seconds(longest_job(mix)))
                / room_} {}

  bool is_bounded() const {
    return room_ > least_room && most_s_ <= longest_window_s;
  }

  /// @returns the responses. What was under way is a whole job that others of
  /// its session may follow at once; after this call it follows its response.
  std::vector<duration> respond() {
    std::vector<duration> all;
    for (std::size_t i = 0; i < mix_.size(); ++i)
      all.push_back(response(i));
    return known_ = all;
  }

private:
  duration deadline(std::size_t j) const {
    return order_ == queue_order::edf ? mix_[j].task.deadline : duration{0};
  }

  // @returns how many jobs of one session may be under way at once.
  std::size_t under_way(std::size_t j) const {
    if (known_.empty())
      return workers_;
    const auto& task = mix_[j].task;
    const auto open =
        releases(task, std::max(known_[j] - instant, duration{0}));
    return std::min(workers_, static_cast<std::size_t>(open));
  }

  // @returns what a session of the group adds if a job of it was under way, to
  // those that are released until `last`. Where those are counted until the
  // job starts (edf), a whole job is right for any such time.
  carried carried_before(std::size_t j, duration last) const {
    const auto& [task, count] = mix_[j];
    if (known_.empty() || order_ == queue_order::edf)
      return {task.wcet, under_way(j) * count};
    const auto since = last + known_[j] + task.jitter;
    const auto all = since / task.period * task.wcet
                     + std::min(task.wcet, since % task.period);
    return {all - releases(task, last) * task.wcet, count};
  }

  // @returns c: what was under way when the window began.
  duration under_way_before(duration due) const {
    std::vector<carried> before, after;
    for (std::size_t j = 0; j < mix_.size(); ++j) {
      const auto last = due - deadline(j);
      if (last >= duration{0}) {
        before.push_back(carried_before(j, last));
      } else if (const auto& task = mix_[j].task; task.wcet > instant) {
        after.push_back({task.wcet - instant, under_way(j) * mix_[j].count});
      }
    }
    std::erase_if(before,
                  [](const carried& x) { return x.work <= duration{0}; });
    duration most{0};
    for (std::size_t k = 0; k < workers_; ++k)
      most = std::max(most,
                      greatest(before, k)
                          + greatest(after, after.empty() ? 0 : workers_ - k));
    return most;
  }

  // @returns how long a job waits that is released `a` after the begin.
  duration wait(std::size_t i, duration a) const {
    const auto due = a + deadline(i);
    const auto under_way = under_way_before(due);
    // First come, first served, what counts has come by `a`.
    auto start = order_ == queue_order::fifo ? a : duration{0};
    for (;;) {
      auto work = under_way;
      for (std::size_t j = 0; j < mix_.size(); ++j) {
        const auto& [task, count] = mix_[j];
        const auto last = due - deadline(j);
        if (last < duration{0})
          continue;
        auto jobs = static_cast<duration::rep>(count)
                    * releases(task, std::min(start, last));
        // The last one of its session is the job itself.
        if (j == i && releases(task, start) >= releases(task, last))
          --jobs;
        work += jobs * task.wcet;
      }
      const auto by = work / static_cast<duration::rep>(workers_);
      if (by <= start)
        return std::max(start - a, duration{0});
      start = by;
    }
  }

  // @returns no less than any job waits that is released `a` or later.
  duration waits_at_most(duration a) const {
    const auto since_s = to_seconds(a);
    const auto share =
        order_ == queue_order::fifo ? room_ / static_cast<double>(workers_) : 1;
    const auto first_s =
        order_ == queue_order::fifo ? most_s_ * share : most_s_;
    return from_seconds(std::max(first_s - since_s * share, 0.0)) + instant;
  }

  // @returns when a count may step up, as `a` of a job of the group.
  std::vector<duration> moments(std::size_t i) const {
    std::vector<duration> all{duration{0}};
    const auto end = from_seconds(most_s_);
    const auto add = [&](duration first, duration period) {
      if (first < duration{0})
        first += (-first + period - instant) / period * period;
      for (auto a = first; a <= end; a += period)
        all.push_back(a);
    };
    for (std::size_t j = 0; j < mix_.size(); ++j) {
      const auto& task = mix_[j].task;
      const auto apart = deadline(j) - deadline(i);
      add(apart - task.jitter, task.period);
      if (apart > duration{0})
        all.push_back(apart);
      if (!known_.empty())
        add(apart - task.jitter - known_[j], task.period);
    }
    std::ranges::sort(all);
    const auto repeated = std::ranges::unique(all);
    all.erase(repeated.begin(), repeated.end());
    return all;
  }

  duration response(std::size_t i) const {
    duration longest{0};
    for (const auto a : moments(i)) {
      if (waits_at_most(a) <= longest)
        break;
      longest = std::max(longest, wait(i, a));
    }
    return longest + mix_[i].task.wcet;
  }

  std::span<const session_group> mix_;
  queue_order order_;
  std::size_t workers_;
  double load_;
  double room_;   // workers that are left
  double most_s_; // of a window
  std::vector<duration> known_;
};

} // namespace

std::optional<std::vector<duration>>
worst_case_responses(std::span<const session_group> mix, queue_order order,
                     std::size_t workers) {
  assert(workers > 0);
  windows all{mix, order, workers};
  if (!all.is_bounded())
    return std::nullopt;
  const auto first = all.respond();
  if (workers == 1)
    return first;
  auto second = all.respond();
  for (std::size_t i = 0; i < second.size(); ++i)
    second[i] = std::min(first[i], second[i]);
  return second;
}

std::optional<std::vector<response_quantile>>
response_quantiles(std::span<const session_group> mix, std::size_t workers) {
  assert(workers > 0);
  const auto m = static_cast<double>(workers);
  const auto room = m - load_of(mix);
  if (room <= least_room)
    return std::nullopt;
  const auto burst = burst_s(mix);
  const auto longest_s = to_seconds(longest_job(mix));
  std::vector<response_quantile> all;
  for (const auto& own : mix) {
    const auto own_s = to_seconds(own.task.wcet);
    const auto wait_s = ((m - 1) * longest_s + burst - own_s) / m;
    auto later = own.task.overrun.probability;
    for (const auto& [task, count] : mix) {
      const auto& [often, beyond_s] = task.overrun;
      const auto harm_s =
          often * to_seconds(task.wcet) + beyond_s * (1 + 2 / room)
          + 3 * often * to_seconds(own.task.period + own.task.jitter);
      later += static_cast<double>(count) * harm_s / to_seconds(task.period);
    }
    all.push_back({from_seconds(own_s + wait_s) + instant, later});
  }
  return all;
}

std::optional<std::vector<response_quantile>>
stated_responses(std::span<const session_group> mix, std::size_t workers) {
  const auto overruns = [](const session_group& group) {
    return group.task.overrun.probability > 0;
  };
  if (std::ranges::any_of(mix, overruns))
    return response_quantiles(mix, workers);
  const auto worst = worst_case_responses(mix, queue_order::fifo, workers);
  if (!worst)
    return std::nullopt;
  std::vector<response_quantile> all;
  for (const auto response : *worst)
    all.push_back({response, 0});
  return all;
}

} // namespace sofof::policies
