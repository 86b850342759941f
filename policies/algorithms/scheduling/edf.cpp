// Whether one core can keep all deadlines, earliest deadline first.
#include "policies/algorithms/scheduling/edf.hpp"

#include <cassert>
#include <optional>

namespace sofof::policies {

namespace {

constexpr duration longest_busy_period = std::chrono::seconds{60};
constexpr double rounding = 1e-12;

/// @returns how long a core computes without a pause after all tasks were
/// released at once; nullopt if too long to be looked at.
std::optional<duration> busy_period(std::span<const periodic_task> tasks) {
  duration busy{0};
  for (const auto& task : tasks)
    busy += task.wcet;
  while (busy <= longest_busy_period) {
    duration work{0};
    for (const auto& task : tasks)
      work += (busy + task.period - duration{1}) / task.period * task.wcet;
    if (work == busy)
      return busy;
    busy = work;
  }
  return std::nullopt;
}

/// @returns the computing time of all jobs released from 0 on and due by t.
duration demand(std::span<const periodic_task> tasks, duration t) {
  duration due{0};
  for (const auto& task : tasks) {
    const auto first = task.deadline - task.jitter;
    if (first <= t)
      due += ((t - first) / task.period + 1) * task.wcet;
  }
  return due;
}

} // namespace

double utilisation(std::span<const periodic_task> tasks) {
  double sum = 0;
  for (const auto& task : tasks) {
    assert(task.wcet >= duration{0} && task.period > duration{0});
    sum += to_seconds(task.wcet) / to_seconds(task.period);
  }
  return sum;
}

bool fits_by_utilisation(std::span<const periodic_task> tasks) {
  return utilisation(tasks) <= 1 + rounding;
}

bool fits_by_demand(std::span<const periodic_task> tasks) {
  if (!fits_by_utilisation(tasks))
    return false;
  const auto busy = busy_period(tasks);
  if (!busy)
    return false;
  for (const auto& task : tasks)
    for (auto t = task.deadline - task.jitter; t <= *busy; t += task.period)
      if (demand(tasks, t) > t)
        return false;
  return true;
}

} // namespace sofof::policies
