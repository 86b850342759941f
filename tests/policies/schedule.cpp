// Tests of admission, placement and phases of sessions on cores.
#include "policies/algorithms/scheduling/edf.hpp"
#include "policies/algorithms/scheduling/phases.hpp"
#include "policies/algorithms/scheduling/placement.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;
using test::dice;

namespace {

using task_set = std::vector<periodic_task>;

int whole(dice& random, int low, int high) {
  return static_cast<int>(random.between(low, high + 1));
}

duration milliseconds_of(int count) {
  return std::chrono::milliseconds{count};
}

// Periods have few multiples, so that everything repeats after 60 ms.
task_set random_tasks(dice& random, int most_jitter_ms) {
  constexpr int periods_ms[]{4, 5, 6, 10, 12, 15, 20};
  task_set tasks(static_cast<std::size_t>(whole(random, 1, 4)));
  for (auto& task : tasks) {
    const auto period_ms = periods_ms[whole(random, 0, 6)];
    const auto wcet_ms = whole(random, 1, std::max(1, period_ms / 3));
    const auto deadline_ms = whole(random, wcet_ms, period_ms + 2);
    task.wcet = milliseconds_of(wcet_ms);
    task.period = milliseconds_of(period_ms);
    task.deadline = milliseconds_of(deadline_ms);
    task.jitter = milliseconds_of(whole(random, 0, most_jitter_ms));
  }
  return tasks;
}

// Earliest deadline first, millisecond by millisecond, without jitter.
// Deliberately nothing like the code that it checks.
bool keeps_deadlines(const task_set& tasks, int until_ms) {
  struct job {
    int deadline_ms;
    int left_ms;
  };
  std::vector<job> ready;
  const auto ms = [](duration d) { return static_cast<int>(d / 1ms); };
  for (int now = 0; now < until_ms; ++now) {
    for (const auto& task : tasks) {
      const auto since_first = now - ms(task.offset);
      if (since_first >= 0 && since_first % ms(task.period) == 0)
        ready.push_back({now + ms(task.deadline), ms(task.wcet)});
    }
    const auto urgent = std::ranges::min_element(ready, {}, &job::deadline_ms);
    if (urgent != ready.end() && --urgent->left_ms == 0) {
      if (now + 1 > urgent->deadline_ms)
        return false;
      ready.erase(urgent);
    }
    for (const auto& waiting : ready)
      if (now + 1 >= waiting.deadline_ms)
        return false;
  }
  return true;
}

// A job that jitter holds back to the last has so much less time.
task_set held_back(task_set tasks) {
  for (auto& task : tasks) {
    task.deadline -= task.jitter;
    task.offset += task.jitter;
  }
  return tasks;
}

task_set released_together(task_set tasks) {
  tasks = held_back(tasks);
  for (auto& task : tasks)
    task.offset = 0ms;
  return tasks;
}

const periodic_task session{.wcet = 8ms, .period = 100ms, .deadline = 20ms};

} // namespace

TEST_CASE("utilisation fills a core to the brim and not beyond") {
  task_set tasks(10, {.wcet = 10ms, .period = 100ms, .deadline = 100ms});
  CHECK(fits_by_utilisation(tasks));
  CHECK(fits_by_demand(tasks));
  tasks[0].wcet += 1ns;
  CHECK(!fits_by_utilisation(tasks));
  CHECK(!fits_by_demand(tasks));
}

TEST_CASE("a core without work fits") {
  CHECK(fits_by_utilisation({}));
  CHECK(fits_by_demand({}));
  CHECK(longest_wait({}) == 0ns);
}

TEST_CASE("a deadline shorter than the computing time, or than the jitter, is "
          "never kept") {
  CHECK(!fits_by_demand(task_set{{8ms, 100ms, 8ms - 1ns}}));
  CHECK(fits_by_demand(task_set{{8ms, 100ms, 8ms}}));
  CHECK(!fits_by_demand(task_set{{8ms, 100ms, 10ms, 3ms}}));
  CHECK(!fits_by_demand(task_set{{8ms, 100ms, 10ms, 30ms}}));
}

TEST_CASE("the demand test says what every released-together schedule shows") {
  dice random{6};
  int kept = 0;
  for (int k = 0; k < 3000; ++k) {
    const auto tasks = random_tasks(random, 2);
    if (utilisation(tasks) > 1)
      continue;
    const auto fits = fits_by_demand(tasks);
    REQUIRE(fits == keeps_deadlines(released_together(tasks), 180));
    kept += fits ? 1 : 0;
  }
  CHECK(kept > 500);
  CHECK(kept < 2500);
}

TEST_CASE("what passes the demand test keeps its deadlines with any offsets") {
  dice random{7};
  for (int k = 0; k < 1000; ++k) {
    auto tasks = random_tasks(random, 2);
    if (!fits_by_demand(tasks))
      continue;
    for (auto& task : tasks)
      task.offset = milliseconds_of(whole(random, 0, 20));
    REQUIRE(keeps_deadlines(held_back(tasks), 200));
    REQUIRE(longest_wait(tasks));
  }
}

TEST_CASE("the longest wait exists exactly where every deadline is kept") {
  dice random{8};
  int kept = 0;
  for (int k = 0; k < 2000; ++k) {
    auto tasks = random_tasks(random, 1);
    for (auto& task : tasks)
      task.offset = milliseconds_of(whole(random, 0, 20));
    if (utilisation(tasks) > 1)
      continue;
    const auto wait = longest_wait(tasks);
    REQUIRE(wait.has_value() == keeps_deadlines(held_back(tasks), 200));
    kept += wait ? 1 : 0;
  }
  CHECK(kept > 300);
}

TEST_CASE("jobs wait for those that are more urgent") {
  const task_set tasks{{8ms, 100ms, 20ms}, {8ms, 100ms, 30ms, 0ms, 5ms}};
  CHECK(longest_wait(tasks) == 3ms);
}

TEST_CASE("an assigned offset keeps all deadlines, and an idle stretch is "
          "found") {
  dice random{9};
  int assigned = 0;
  int possible = 0;
  for (int k = 0; k < 1000; ++k) {
    auto tasks = random_tasks(random, 1);
    for (auto& task : tasks)
      task.offset = milliseconds_of(whole(random, 0, 19));
    if (!longest_wait(tasks))
      continue;
    auto task = random_tasks(random, 1).front();
    const auto offset = assigned_offset(tasks, task);
    tasks.push_back(task);
    bool any = false;
    bool without_wait = false;
    for (task.offset = 0ms; task.offset < task.period; task.offset += 1ms) {
      tasks.back() = task;
      const auto wait = longest_wait(tasks);
      any |= wait.has_value();
      without_wait |= wait == 0ns;
    }
    possible += any ? 1 : 0;
    REQUIRE((offset || !without_wait));
    if (!offset)
      continue;
    ++assigned;
    REQUIRE(*offset >= 0ms);
    REQUIRE(*offset < task.period);
    tasks.back().offset = *offset;
    REQUIRE(keeps_deadlines(held_back(tasks), 200));
    if (without_wait)
      REQUIRE(longest_wait(tasks) == 0ns);
  }
  MESSAGE(assigned << " of " << possible << " possible offsets found");
  CHECK(assigned > 0.95 * possible);
}

TEST_CASE("periods without a common multiple within a second get no phases") {
  const task_set tasks{{1ms, 33'333'333ns, 10ms}};
  CHECK(!longest_wait(task_set{{1ms, 33'333'333ns, 10ms}, session}));
  CHECK(!assigned_offset(tasks, session));
  CHECK(fits_by_demand(task_set{{1ms, 33'333'333ns, 10ms}, session}));
}

TEST_CASE("a session goes to the emptiest core that can take it") {
  const periodic_task easy{2ms, 100ms, 100ms};
  std::vector<task_set> cores{{easy, easy}, {easy}, {easy}};
  CHECK(worst_fit(cores, easy, admission_test::demand) == core_place{1});
  cores[1] = {periodic_task{1ms, 100ms, 2ms}, periodic_task{1ms, 100ms, 2ms}};
  const periodic_task urgent{1ms, 100ms, 1ms};
  cores[2].push_back(easy);
  CHECK(worst_fit(cores, urgent, admission_test::utilisation) == core_place{1});
  CHECK(worst_fit(cores, urgent, admission_test::demand) == core_place{0});
}

TEST_CASE("a session that no core can take is rejected") {
  const std::vector<task_set> cores{{session, session}, {session, session}};
  CHECK(worst_fit(cores, session, admission_test::demand) == std::nullopt);
  CHECK(worst_fit({}, session, admission_test::utilisation) == std::nullopt);
}

TEST_CASE("a slot that became free is given to the next session") {
  std::vector<task_set> cores(1);
  for (int k = 0; k < 12; ++k) {
    auto next = session;
    next.offset =
        worst_fit(cores, session, admission_test::phases).value().offset;
    cores[0].push_back(next);
  }
  CHECK(worst_fit(cores, session, admission_test::phases) == std::nullopt);
  const auto free = cores[0][4].offset;
  cores[0].erase(cores[0].begin() + 4);
  CHECK(worst_fit(cores, session, admission_test::phases)
        == core_place{0, free});
}
