// When in the period each session of a core is to compute.
#include "policies/algorithms/scheduling/phases.hpp"

#include "policies/algorithms/scheduling/edf.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <queue>
#include <vector>

namespace sofof::policies {

namespace {

constexpr duration longest_hyperperiod = std::chrono::seconds{1};

struct job {
  duration release;
  duration deadline;
  duration wcet;
  duration left;
};

std::optional<duration> hyperperiod(std::span<const periodic_task> tasks) {
  duration multiple{1};
  for (const auto& task : tasks) {
    assert(task.period > duration{0});
    if (task.period > longest_hyperperiod)
      return std::nullopt;
    multiple = duration{std::lcm(multiple.count(), task.period.count())};
    if (multiple > longest_hyperperiod)
      return std::nullopt;
  }
  return multiple;
}

/// @returns the jobs of all tasks in order of their release, as late as can be.
std::vector<job> jobs_until(std::span<const periodic_task> tasks,
                            duration horizon) {
  std::vector<job> jobs;
  for (const auto& task : tasks)
    for (auto arrival = task.offset; arrival < horizon; arrival += task.period)
      jobs.push_back({arrival + task.jitter, arrival + task.deadline, task.wcet,
                      task.wcet});
  std::ranges::stable_sort(jobs, {}, &job::release);
  return jobs;
}

/// @returns the longest wait of the jobs; nullopt if one is late.
std::optional<duration> play(std::vector<job> jobs) {
  const auto is_less_urgent = [&](std::size_t a, std::size_t b) {
    return std::pair{jobs[a].deadline, a} > std::pair{jobs[b].deadline, b};
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>,
                      decltype(is_less_urgent)>
      ready{is_less_urgent};
  duration now{0};
  duration wait{0};
  std::size_t released = 0;
  while (released < jobs.size() || !ready.empty()) {
    if (ready.empty())
      now = std::max(now, jobs[released].release);
    while (released < jobs.size() && jobs[released].release <= now)
      ready.push(released++);
    auto& current = jobs[ready.top()];
    auto until = now + current.left;
    if (released < jobs.size())
      until = std::min(until, jobs[released].release);
    current.left -= until - now;
    now = until;
    if (current.left > duration{0})
      continue;
    ready.pop();
    if (now > current.deadline)
      return std::nullopt;
    wait = std::max(wait, now - current.release - current.wcet);
  }
  return wait;
}

/// @returns offsets of a task with which its jobs are released when a job of
/// another would be done, and 0; rising, each once.
std::vector<duration> candidates(std::span<const periodic_task> running,
                                 const periodic_task& task, duration multiple) {
  std::vector<duration> offsets{duration{0}};
  for (const auto& other : running)
    for (duration t{0}; t < multiple; t += other.period) {
      const auto done = other.offset + other.jitter + other.wcet + t;
      const auto offset = (done - task.jitter) % task.period;
      offsets.push_back(offset < duration{0} ? offset + task.period : offset);
    }
  std::ranges::sort(offsets);
  const auto repeated = std::ranges::unique(offsets);
  offsets.erase(repeated.begin(), repeated.end());
  return offsets;
}

} // namespace

std::optional<duration> longest_wait(std::span<const periodic_task> tasks) {
  const auto multiple = hyperperiod(tasks);
  if (!multiple || !fits_by_utilisation(tasks))
    return std::nullopt;
  duration last_start{0};
  for (const auto& task : tasks) {
    assert(task.offset >= duration{0} && task.jitter >= duration{0});
    last_start = std::max(last_start, task.offset + task.jitter);
  }
  return play(jobs_until(tasks, last_start + 2 * *multiple));
}

std::optional<duration> assigned_offset(std::span<const periodic_task> running,
                                        const periodic_task& task) {
  std::vector<periodic_task> tasks{running.begin(), running.end()};
  tasks.push_back(task);
  const auto multiple = hyperperiod(tasks);
  if (!multiple)
    return std::nullopt;
  std::optional<duration> best;
  auto least = duration::max();
  for (const auto offset : candidates(running, task, *multiple)) {
    tasks.back().offset = offset;
    const auto wait = longest_wait(tasks);
    if (!wait || *wait >= least)
      continue;
    best = offset;
    least = *wait;
    if (least == duration{0})
      break;
  }
  return best;
}

} // namespace sofof::policies
