// Tests of when a function runs, without any actor.
#include "offloading/service_cycle.hpp"

#include "tests/support/echo.hpp"

#include <doctest/doctest.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

/// A cycle whose results take 5 ms, and the timers that it has set.
struct cycle_world : offloading::cycle_port {
  struct copier final : offloading::service_function {
    offloading::service_output run(time_point,
                                   const service_input& input) override {
      return input.what;
    }
    void observe(time_point at, const service_input& input) override {
      observed.emplace_back(at, input.what.as<echo>()->number);
    }
    void on_step(lifecycle_step step, time_point) override {
      steps.push_back(step);
    }
    std::vector<std::pair<time_point, std::uint64_t>> observed;
    std::vector<lifecycle_step> steps;
  };

  time_point now{1s};
  std::shared_ptr<copier> function = std::make_shared<copier>();
  std::multimap<time_point, std::uint64_t> timers;
  std::vector<std::pair<time_point, service_result>> results;
  offloading::service_cycle cycle{
      {{1, 101, "echo", 7},
       function,
       50ms,
       20ms,
       [](time_point start, std::uint64_t) {
         return offloading::cycle_work{start + 5ms, 3ms};
       }},
      *this};

  void wake_at(time_point t, std::uint64_t number) override {
    timers.emplace(t, number);
  }
  void deliver_at(time_point t, service_result result) override {
    results.emplace_back(t, std::move(result));
  }

  void run_for(duration d) {
    const auto end = now + d;
    while (!timers.empty() && timers.begin()->first <= end) {
      const auto due = timers.extract(timers.begin());
      now = due.key();
      cycle.on_timer(due.mapped(), now);
    }
    now = end;
  }
  void feed(std::uint64_t number, bool stands_by = false) {
    cycle.on_input(
        {{1, 101, "echo", 7}, now, payload::of(echo{number}), {}, stands_by},
        now);
  }
  void activate() {
    cycle.on_step(lifecycle_step::configure, now);
    cycle.on_step(lifecycle_step::activate, now);
  }
  std::vector<duration> starts() const {
    std::vector<duration> all;
    for (const auto& [done, result] : results)
      all.push_back(result.created - time_point{1s});
    return all;
  }
};

} // namespace

TEST_CASE_FIXTURE(cycle_world,
                  "an active cycle runs at once, then on its grid, "
                  "and each result is done after its run time") {
  feed(1);
  activate();
  run_for(100ms);
  CHECK(starts() == std::vector<duration>{0ms, 20ms, 70ms});
  for (const auto& [done, result] : results)
    CHECK(done == result.created + 5ms);
}

TEST_CASE_FIXTURE(cycle_world, "a cycle without input, or not active, runs "
                               "nothing") {
  activate();
  run_for(1s);
  CHECK(results.empty());
  cycle.on_step(lifecycle_step::deactivate, now);
  feed(1);
  run_for(1s);
  CHECK(results.empty());
}

TEST_CASE_FIXTURE(cycle_world, "a function that does not run observes each "
                               "input, one that runs none") {
  feed(1);
  activate();
  feed(2);
  run_for(60ms);
  cycle.on_step(lifecycle_step::deactivate, now);
  feed(3);
  CHECK(function->observed
        == std::vector{std::pair{time_point{1s}, std::uint64_t{1}},
                       std::pair{time_point{1060ms}, std::uint64_t{3}}});
}

TEST_CASE_FIXTURE(cycle_world, "a function is told each step that is taken") {
  using enum lifecycle_step;
  cycle.on_step(activate, now); // it is not configured
  CHECK(function->steps.empty());
  this->activate();
  cycle.on_step(deactivate, now);
  cycle.on_step(shut_down, now);
  cycle.on_step(shut_down, now);
  CHECK(function->steps
        == std::vector{configure, activate, deactivate, shut_down});
}

TEST_CASE_FIXTURE(cycle_world, "a cycle that is activated again forgets the "
                               "timers of before") {
  feed(1);
  activate();
  cycle.on_step(lifecycle_step::deactivate, now);
  cycle.on_step(lifecycle_step::activate, now);
  results.clear();
  run_for(50ms);
  CHECK(starts() == std::vector<duration>{20ms});
}

TEST_CASE_FIXTURE(cycle_world, "a cycle that stands by runs once for each "
                               "input, but not ahead of its grid by two") {
  feed(1, true);
  activate();
  feed(2, true);
  feed(3, true); // one too many in this period
  run_for(1s);
  CHECK(results.size() == 2);
  feed(4, true);
  CHECK(results.size() == 3);
}

TEST_CASE_FIXTURE(cycle_world, "an input that says so begins a cycle at once, "
                               "and the grid goes on") {
  feed(1);
  activate(); // on its grid at 20 ms, 70 ms, ...
  run_for(30ms);
  results.clear();
  cycle.on_input({.session = {1, 101, "echo", 7},
                  .at = now,
                  .what = payload::of(echo{2}),
                  .at_once = true},
                 now);
  run_for(70ms);
  CHECK(starts() == std::vector<duration>{30ms, 70ms});
  CHECK(results[0].second.cycle < results[1].second.cycle);
}

TEST_CASE_FIXTURE(cycle_world, "inputs that say so have two cycles more than "
                               "one that stands by, and no third one") {
  feed(1, true);
  activate();
  feed(2, true);
  for (std::uint64_t k = 3; k < 6; ++k)
    cycle.on_input({.session = {1, 101, "echo", 7},
                    .at = now,
                    .what = payload::of(echo{k}),
                    .standby = true,
                    .at_once = true},
                   now);
  CHECK(results.size() == 4);
  run_for(100ms);
  feed(6, true);
  CHECK(results.size() == 4); // the grid has not caught up
  run_for(50ms);
  feed(7, true);
  CHECK(results.size() == 5);
}

TEST_CASE_FIXTURE(cycle_world, "numbers of cycles rise, and follow the grid "
                               "when a period was not used") {
  feed(1);
  activate();
  run_for(100ms);
  const auto last = results.back().second.cycle;
  cycle.on_step(lifecycle_step::deactivate, now);
  run_for(1s);
  cycle.on_step(lifecycle_step::activate, now);
  CHECK(results.back().second.cycle == last + 20);
}

TEST_CASE_FIXTURE(cycle_world, "a result tells when its input was made, how "
                               "that came, and where the cycle's time went") {
  const auto made = now - 30ms;
  cycle.on_input({.session = {1, 101, "echo", 7},
                  .at = made,
                  .what = payload::of(echo{1}),
                  .up = {4ms, 8ms}},
                 now);
  activate();
  REQUIRE(results.size() == 1);
  const auto& timing = results.front().second.timing;
  CHECK(timing.input_at == made);
  CHECK(timing.up == transit{4ms, 8ms});
  CHECK(timing.queue == 2ms);
  CHECK(timing.computing == 3ms);
}

namespace {

/// One result for each input.
struct per_input_world : cycle_world {
  offloading::service_cycle each{
      {.session = {1, 101, "echo", 7},
       .function = std::make_shared<copier>(),
       .period = 50ms,
       .phase = 20ms,
       .finish = [](time_point start,
                    std::uint64_t) { return offloading::cycle_work{start}; },
       .per_input = true},
      *this};

  per_input_world() {
    each.on_step(lifecycle_step::configure, now);
    each.on_step(lifecycle_step::activate, now);
  }
  void feed(std::uint64_t number, duration age) {
    each.on_input({.session = {1, 101, "echo", 7},
                   .at = now - age,
                   .what = payload::of(echo{number})},
                  now);
  }
};

} // namespace

TEST_CASE_FIXTURE(per_input_world,
                  "with one result per input, each input is computed at once, "
                  "its latency begins with it, and no other result comes") {
  for (std::uint64_t n = 0; n < 4; ++n) {
    feed(n, 15ms);
    run_for(50ms);
  }
  run_for(1s);
  REQUIRE(results.size() == 4);
  for (std::uint64_t n = 0; n < 4; ++n) {
    const auto& [done, result] = results[n];
    CHECK(done == time_point{1s} + n * 50ms);
    CHECK(result.created == done - 15ms);
    CHECK(result.what.as<echo>()->number == n);
  }
  CHECK(timers.empty());
}

TEST_CASE_FIXTURE(per_input_world, "with one result per input, inputs beyond "
                                   "the period's rate have none") {
  for (std::uint64_t n = 0; n < 1000; ++n) {
    feed(n, 1ms);
    run_for(1ms);
  }
  CHECK(results.size() >= 20);
  CHECK(results.size() <= 22);
}

TEST_CASE_FIXTURE(cycle_world, "an input that a newer one has overtaken on its "
                               "way is not used") {
  const service_input older{{1, 101, "echo", 7}, now, payload::of(echo{1})};
  now += 10ms;
  feed(2);
  activate();
  cycle.on_input(older, now);
  run_for(100ms);
  REQUIRE(results.size() >= 2);
  for (const auto& [done, result] : results) {
    CHECK(result.what.as<echo>()->number == 2);
    CHECK(result.timing.input_at == older.at + 10ms);
  }
}

namespace {

/// A cycle that was to take 5 ms, until something takes the core from it.
struct interrupted_world : cycle_world {
  time_point done;
  offloading::service_cycle shared{
      {.session = {0, 101, "echo", 0},
       .function = function,
       .period = 50ms,
       .phase = 20ms,
       .finish =
           [this](time_point start, std::uint64_t) {
             done = start + 5ms;
             return offloading::cycle_work{done, 5ms};
           },
       .review = [this](time_point) { return done; }},
      *this};

  interrupted_world() {
    shared.on_step(lifecycle_step::configure, now);
    feed(1);
    shared.on_step(lifecycle_step::activate, now);
  }
  void feed(std::uint64_t number) {
    shared.on_input({{}, now, payload::of(echo{number})}, now);
  }
  void run_for(duration d) {
    const auto end = now + d;
    while (!timers.empty() && timers.begin()->first <= end) {
      const auto due = timers.extract(timers.begin());
      now = due.key();
      shared.on_timer(due.mapped(), now);
    }
    now = end;
  }
};

} // namespace

TEST_CASE_FIXTURE(interrupted_world,
                  "a result whose computing was interrupted is told when it is "
                  "done, with what it waited") {
  done += 7ms;
  run_for(11ms);
  CHECK(results.empty());
  run_for(1ms);
  REQUIRE(results.size() == 1);
  const auto& [at, result] = results.front();
  CHECK(at == time_point{1012ms});
  CHECK(result.created == time_point{1s});
  CHECK(result.timing.queue == 7ms);
  CHECK(result.timing.computing == 5ms);
}

TEST_CASE_FIXTURE(interrupted_world,
                  "on a shared core the next cycle begins when the one under "
                  "way is done, from the newest input then") {
  done += 25ms; // past the grid's 20 ms
  run_for(22ms);
  feed(2);
  run_for(30ms);
  CHECK(starts() == std::vector<duration>{0ms, 30ms});
  CHECK(results.back().first == time_point{1035ms});
  CHECK(results.back().second.what.as<echo>()->number == 2);
  run_for(50ms); // and the grid goes on
  CHECK(starts() == std::vector<duration>{0ms, 30ms, 70ms});
}

TEST_CASE_FIXTURE(interrupted_world,
                  "an input that says so while a cycle is under way begins one "
                  "besides the grid when that is done") {
  done += 7ms;
  run_for(3ms);
  shared.on_input(
      {.session = {}, .at = now, .what = payload::of(echo{2}), .at_once = true},
      now);
  run_for(15ms);
  CHECK(starts() == std::vector<duration>{0ms, 12ms});
  REQUIRE(results.size() == 2);
  CHECK(results[0].second.cycle < results[1].second.cycle);
}

TEST_CASE_FIXTURE(interrupted_world,
                  "who comes home while its last cycle is under way begins "
                  "when that is done, who leaves meanwhile does not") {
  done += 25ms;
  shared.on_step(lifecycle_step::deactivate, now);
  shared.on_step(lifecycle_step::activate, now);
  run_for(32ms);
  CHECK(starts() == std::vector<duration>{0ms});
  run_for(10ms);
  CHECK(starts() == std::vector<duration>{0ms, 30ms});
  run_for(30ms); // 72 ms: one is under way
  shared.on_step(lifecycle_step::deactivate, now);
  run_for(1s);
  CHECK(starts() == std::vector<duration>{0ms, 30ms, 70ms});
}
