// Tests of how long functions on a shared core take at most.
#include "policies/algorithms/scheduling/preemptive.hpp"

#include <doctest/doctest.h>

#include <optional>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;

namespace {

periodic_task task(duration wcet, duration period, duration jitter = 0ms) {
  return {.wcet = wcet, .period = period, .deadline = period, .jitter = jitter};
}

using responses = std::vector<std::optional<duration>>;

responses by_priority(const std::vector<periodic_task>& tasks) {
  return preemptive_responses(tasks, core_order::fixed_priority);
}

responses by_deadlines(const std::vector<periodic_task>& tasks) {
  return preemptive_responses(tasks, core_order::edf);
}

} // namespace

TEST_CASE("responses by fixed priorities are those of the textbook") {
  // Burns & Wellings, Real-Time Systems and Programming Languages.
  CHECK(by_priority({task(3ms, 7ms), task(3ms, 12ms), task(5ms, 20ms)})
        == responses{3ms, 6ms, 20ms});
  CHECK(by_priority({task(5ms, 20ms), task(10ms, 40ms), task(40ms, 80ms)})
        == responses{5ms, 15ms, 80ms});
}

TEST_CASE("jitter of those before lets more of their jobs come together") {
  const auto last = [](duration jitter) {
    return by_priority({task(10ms, 100ms, jitter), task(5ms, 100ms)})[1];
  };
  CHECK(last(0ms) == 15ms);
  CHECK(last(jitter_with_first_cycle(100ms)) == 25ms);
  CHECK(last(jitter_of_calls(100ms)) == 35ms);
  // Its own do not: it has one job at a time.
  CHECK(by_priority({task(10ms, 100ms, jitter_of_calls(100ms))})
        == responses{10ms});
}

TEST_CASE("whoever comes first has a bound, whatever those behind ask for") {
  CHECK(by_priority({task(6ms, 10ms), task(5ms, 10ms), task(1ms, 100ms)})
        == responses{6ms, 17ms, std::nullopt});
  CHECK(by_deadlines({task(6ms, 10ms), task(5ms, 10ms)})
        == responses{std::nullopt, std::nullopt});
}

TEST_CASE(
    "by deadlines no response is longer than the deadline where all fit") {
  const std::vector tasks{task(3ms, 7ms), task(3ms, 12ms), task(6ms, 20ms)};
  const auto all = by_deadlines(tasks);
  for (std::size_t k = 0; k < tasks.size(); ++k)
    CHECK(all[k].value() <= tasks[k].deadline);
  CHECK(by_priority(tasks).back() > tasks.back().deadline);
  // Those that are due alike are as one.
  CHECK(by_deadlines({task(3ms, 10ms), task(4ms, 10ms)})
        == responses{7ms, 7ms});
  // One whose deadline is far off is never in the way of one that is near.
  CHECK(by_deadlines({task(1ms, 10ms), task(50ms, 1s)}).front() == 1ms);
}

TEST_CASE("by deadlines two of one function come one after the other") {
  const auto alone = by_deadlines({task(10ms, 100ms, jitter_of_calls(100ms))});
  CHECK(alone == responses{10ms});
}

TEST_CASE("functions go to the core that has least to do") {
  const std::vector<periodic_task> tasks{task(1ms, 10ms), task(5ms, 10ms),
                                         task(3ms, 10ms), task(3ms, 10ms)};
  CHECK(share_out(tasks, 2) == std::vector<std::size_t>{0, 0, 1, 1});
  CHECK(share_out(tasks, 1) == std::vector<std::size_t>{0, 0, 0, 0});
}
