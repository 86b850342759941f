// Tests of a core that functions share.
#include "channel/preemptive_core.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using namespace std::chrono_literals;

namespace {

constexpr time_point begin{1s};

/// What is released, and when.
struct release {
  duration at;
  std::size_t function;
  duration work, deadline;
};

/// @param jobs  By their releases; one of each function.
/// @returns when each is done, by function.
std::vector<duration> played(core_order order,
                             const std::vector<release>& jobs) {
  preemptive_core core{order, jobs.size()};
  std::vector<duration> done(jobs.size());
  for (const auto& job : jobs)
    core.begin(job.function, begin + job.at, job.work,
               begin + job.at + job.deadline);
  for (std::size_t k = 0; k < jobs.size(); ++k)
    done[k] = core.done_at(k, begin + 1s) - begin;
  return done;
}

} // namespace

TEST_CASE(
    "by fixed priorities a job waits for all that are before it, whenever "
    "they come") {
  const auto done =
      played(core_order::fixed_priority,
             {{0ms, 2, 5ms, 9ms}, {2ms, 1, 3ms, 99ms}, {3ms, 0, 1ms, 99ms}});
  CHECK(done == std::vector<duration>{4ms, 6ms, 9ms});
}

TEST_CASE("by deadlines the job goes first that is due first") {
  const auto done =
      played(core_order::edf,
             {{0ms, 0, 5ms, 20ms}, {2ms, 1, 3ms, 10ms}, {3ms, 2, 1ms, 30ms}});
  CHECK(done == std::vector<duration>{8ms, 5ms, 9ms});
  const auto even =
      played(core_order::edf, {{0ms, 1, 5ms, 20ms}, {2ms, 0, 3ms, 18ms}});
  CHECK(even == std::vector<duration>{5ms, 8ms});
}

TEST_CASE("what comes when a job is done does not delay it") {
  preemptive_core core{core_order::fixed_priority, 2};
  core.begin(1, begin, 5ms, begin);
  CHECK(core.done_at(1, begin) == begin + 5ms);
  core.begin(0, begin + 5ms, 3ms, begin);
  CHECK(core.done_at(1, begin + 6ms) == begin + 5ms);
  CHECK(core.done_at(0, begin + 6ms) == begin + 8ms);
  CHECK(core.is_under_way(0, begin + 6ms));
  CHECK(!core.is_under_way(1, begin + 6ms));
}

TEST_CASE("a job without work is done when nothing is before it") {
  preemptive_core core{core_order::fixed_priority, 2};
  core.begin(1, begin, 0ms, begin);
  CHECK(core.done_at(1, begin) == begin);
  core.begin(0, begin, 3ms, begin);
  core.begin(1, begin + 1ms, 0ms, begin);
  CHECK(core.done_at(1, begin + 1ms) == begin + 3ms);
}

TEST_CASE("what is said of a job only becomes later, and no work is lost") {
  for (const auto order : {core_order::fixed_priority, core_order::edf})
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      CAPTURE(seed);
      test::dice draw{seed};
      constexpr std::size_t functions = 4;
      preemptive_core core{order, functions};
      std::array<time_point, functions> said{};
      auto now = begin;
      duration all{};
      for (int k = 0; k < 500; ++k) {
        now += from_seconds(draw.between(0, 0.01));
        const auto which = static_cast<std::size_t>(draw.between(0, functions));
        if (core.is_under_way(which, now))
          continue;
        const auto work = from_seconds(draw.between(0, 0.01));
        all += work;
        core.begin(which, now, work, now + from_seconds(draw.between(0, 0.1)));
        said[which] = now;
        for (std::size_t f = 0; f < functions; ++f) {
          const auto done = core.done_at(f, now);
          CHECK(done >= said[f]);
          said[f] = done;
        }
      }
      auto last = begin;
      for (std::size_t f = 0; f < functions; ++f)
        last = std::max(last, core.done_at(f, now));
      CHECK(last - begin >= all);
      CHECK(last - begin <= now - begin + all);
    }
}
