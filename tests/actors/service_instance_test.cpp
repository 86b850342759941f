// Tests of the service instance: life cycle, grid, cycle numbers.
#include "actors/offloading/service_instance.hpp"

#include "tests/support/echo_service.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <map>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

/// Gives back its input unless told to be silent; counts its runs.
struct counting_function final : offloading::service_function {
  int runs = 0;
  bool silent = false;

  offloading::service_output run(time_point,
                                 const service_input& input) override {
    ++runs;
    if (silent)
      return {};
    return input.what;
  }
};

struct instance_world : virtual_world {
  const session_id running{1, 101, "echo", 7};
  std::shared_ptr<counting_function> function =
      std::make_shared<counting_function>();
  probe<result_actor> results = listen<result_actor>();
  instance_actor instance = own(spawn_instance(system(), setup()));

  instance_setup setup() {
    return {{running, function, 50ms, 20ms,
             [](time_point start, std::uint64_t) { return start + 5ms; }},
            results.handle};
  }

  void step(lifecycle_step s) { tell(instance, s); }
  void start() {
    step(lifecycle_step::configure);
    step(lifecycle_step::activate);
  }
  void feed(std::uint64_t number) {
    tell(instance, service_input{running, now(), payload::of(echo{number})});
  }
  void call(std::uint64_t number) {
    tell(instance,
         service_input{running, now(), payload::of(echo{number}), {}, true});
  }
  std::vector<time_point> starts() const {
    std::vector<time_point> all;
    for (const auto& r : results->all<service_result>())
      all.push_back(r.created);
    return all;
  }
};

} // namespace

TEST_CASE_FIXTURE(instance_world, "an instance begins unconfigured, and an "
                                  "impossible step is ignored") {
  feed(1);
  step(lifecycle_step::activate);
  step(lifecycle_step::deactivate);
  run_for(1s);
  CHECK(function->runs == 0);
  CHECK(!is_gone(instance));
}

TEST_CASE_FIXTURE(instance_world, "an inactive instance does not run") {
  feed(1);
  step(lifecycle_step::configure);
  run_for(1s);
  CHECK(function->runs == 0);
}

TEST_CASE_FIXTURE(
    instance_world,
    "an instance runs at once when activated, and then on its grid") {
  run_for(100ms);
  feed(1);
  start();
  run_for(125ms);
  CHECK(starts()
        == std::vector{time_point{100ms}, time_point{120ms}, time_point{170ms},
                       time_point{220ms}});
}

TEST_CASE_FIXTURE(instance_world, "an instance that keeps its phase runs on "
                                  "its grid only") {
  auto kept = setup();
  kept.cycle.keeps_phase = true;
  instance = own(spawn_instance(system(), kept));
  run_for(100ms);
  feed(1);
  start();
  run_for(75ms);
  CHECK(starts() == std::vector{time_point{120ms}, time_point{170ms}});
}

TEST_CASE_FIXTURE(instance_world,
                  "an instance activated on its grid runs once there") {
  run_for(120ms);
  feed(1);
  start();
  run_for(49ms);
  CHECK(starts() == std::vector{time_point{120ms}});
  run_for(10ms);
  CHECK(starts() == std::vector{time_point{120ms}, time_point{170ms}});
}

TEST_CASE_FIXTURE(instance_world, "a result comes when its cycle is done") {
  run_for(100ms);
  feed(1);
  start();
  run_for(5ms - 1ns);
  CHECK(results->count<service_result>() == 0);
  run_for(1ns);
  REQUIRE(results->count<service_result>() == 1);
  const auto result = results->all<service_result>().front();
  CHECK(result.session == running);
  CHECK(result.created == time_point{100ms});
  REQUIRE(result.what.as<echo>());
  CHECK(result.what.as<echo>()->number == 1);
}

TEST_CASE_FIXTURE(instance_world,
                  "cycles are numbered by the grid, whenever one starts") {
  auto late_results = listen<result_actor>();
  auto late_setup = setup();
  late_setup.results = late_results.handle;
  auto late = own(spawn_instance(system(), late_setup));
  feed(1);
  start();
  run_for(1s);
  tell(late, service_input{running, now(), payload::of(echo{1})});
  tell(late, lifecycle_step::configure);
  tell(late, lifecycle_step::activate);
  run_for(1s);
  std::map<time_point, std::uint64_t> early;
  auto last = results->all<service_result>().front().cycle;
  for (const auto& r : results->all<service_result>()) {
    early[r.created] = r.cycle;
    CHECK(r.cycle <= last + 1); // without a gap
    last = r.cycle;
  }
  int compared = 0;
  for (const auto& r : late_results->all<service_result>())
    if (auto i = early.find(r.created); i != early.end()) {
      CHECK(r.cycle == i->second);
      ++compared;
    }
  CHECK(compared == 20);
}

TEST_CASE_FIXTURE(instance_world, "the run time is that of the cycle") {
  std::vector<std::pair<time_point, std::uint64_t>> asked;
  auto timed = setup();
  timed.cycle.finish = [&](time_point start, std::uint64_t cycle) {
    asked.emplace_back(start, cycle);
    return start;
  };
  auto other = own(spawn_instance(system(), timed));
  tell(other, service_input{running, now(), payload::of(echo{1})});
  tell(other, lifecycle_step::configure);
  tell(other, lifecycle_step::activate);
  run_for(1s);
  const auto all = results->all<service_result>();
  REQUIRE(all.size() == 21); // at 0 ms, then 20 ms, 70 ms … 970 ms
  REQUIRE(asked.size() == all.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    CHECK(asked[k] == std::pair{all[k].created, all[k].cycle});
}

TEST_CASE_FIXTURE(instance_world,
                  "without any input an instance waits, then joins its grid") {
  start();
  run_for(200ms);
  CHECK(function->runs == 0);
  feed(1);
  run_for(50ms);
  CHECK(starts() == std::vector{time_point{220ms}});
}

TEST_CASE_FIXTURE(instance_world, "newer input replaces older") {
  feed(1);
  feed(2);
  start();
  feed(3);
  run_for(60ms);
  const auto all = results->all<service_result>();
  REQUIRE(all.size() == 2);
  CHECK(all[0].what.as<echo>()->number == 2);
  CHECK(all[1].what.as<echo>()->number == 3);
}

TEST_CASE_FIXTURE(instance_world, "an instance on call runs one cycle for each "
                                  "input, at once") {
  run_for(100ms);
  call(1);
  start();
  run_for(203ms);
  call(2);
  run_for(1s);
  CHECK(starts() == std::vector{time_point{100ms}, time_point{303ms}});
  CHECK(results->all<service_result>().back().what.as<echo>()->number == 2);
}

TEST_CASE_FIXTURE(instance_world, "an instance that is called twice in a "
                                  "period runs two cycles") {
  feed(1);
  start();
  run_for(20ms);
  call(2);
  call(3);
  run_for(10ms);
  feed(4);
  run_for(1s);
  const auto all = results->all<service_result>();
  REQUIRE(all.size() > 20);
  for (std::size_t k = 1; k < all.size(); ++k)
    CHECK(all[k].cycle > all[k - 1].cycle);
}

TEST_CASE_FIXTURE(instance_world, "however often it is called an instance runs "
                                  "no more than one cycle ahead of its grid") {
  run_for(100ms);
  call(1);
  start();
  for (std::uint64_t k = 0; k < 1000; ++k) {
    run_for(1ms);
    k % 3 ? call(k) : feed(k);
  }
  CHECK(function->runs >= 20);
  CHECK(function->runs <= 22);
}

TEST_CASE_FIXTURE(instance_world, "an instance that is no longer on call goes "
                                  "on at once, on its grid") {
  run_for(100ms);
  call(1);
  start();
  run_for(33ms);
  feed(2);
  feed(3);
  run_for(100ms);
  CHECK(starts()
        == std::vector{time_point{100ms}, time_point{133ms}, time_point{170ms},
                       time_point{220ms}});
  call(4);
  run_for(1s);
  CHECK(starts().size() == 5);
}

TEST_CASE_FIXTURE(instance_world, "a cycle without a result sends none") {
  function->silent = true;
  feed(1);
  start();
  run_for(1s);
  CHECK(function->runs == 21);
  CHECK(results->count<service_result>() == 0);
}

TEST_CASE_FIXTURE(instance_world, "a deactivated instance does not run") {
  feed(1);
  start();
  run_for(500ms);
  const auto runs = function->runs;
  step(lifecycle_step::deactivate);
  feed(2);
  run_for(1s);
  CHECK(function->runs == runs);
}

TEST_CASE_FIXTURE(instance_world, "an instance activated again runs at once, "
                                  "from the newest input, on one grid") {
  feed(1);
  start();
  run_for(500ms);
  step(lifecycle_step::deactivate);
  feed(2);
  step(lifecycle_step::activate);
  step(lifecycle_step::activate);
  run_for(5ms);
  CHECK(starts().back() == time_point{500ms});
  CHECK(results->all<service_result>().back().what.as<echo>()->number == 2);
  results->clear();
  run_for(1s);
  CHECK(results->count<service_result>() == 20);
}

TEST_CASE_FIXTURE(instance_world, "a finalized instance quits") {
  feed(1);
  start();
  run_for(100ms);
  const auto runs = function->runs;
  step(lifecycle_step::shut_down);
  CHECK(is_gone(instance));
  run_for(1s);
  CHECK(function->runs == runs);
}

TEST_CASE_FIXTURE(instance_world,
                  "an instance that never ran can be finalized") {
  step(lifecycle_step::shut_down);
  CHECK(is_gone(instance));
}
