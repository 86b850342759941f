// Tests of the QoS watchdog.
#include "actors/offloading/qos_watchdog.hpp"

#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

const session_id running{1, 101, "trajectory_planning", 7};

struct watchdog_world : virtual_world {
  probe<onboard_requester_actor> requester = listen<onboard_requester_actor>();
  watchdog_actor dog =
      own(spawn_qos_watchdog(system(), {50ms, 100ms}, requester.handle));

  void arrive(duration latency = 10ms) {
    tell(dog, arrival{running, now() - latency, now()});
  }
};

} // namespace

TEST_CASE_FIXTURE(watchdog_world, "the watchdog sleeps until it is armed") {
  run_for(10s);
  CHECK(requester->count<qos_violation>() == 0);
}

TEST_CASE_FIXTURE(
    watchdog_world,
    "the watchdog barks when the gap is one nanosecond too long") {
  tell(dog, running, now());
  run_for(100ms);
  CHECK(requester->count<qos_violation>() == 0);
  run_for(1ns);
  REQUIRE(requester->count<qos_violation>() == 1);
  const auto violation = requester->all<qos_violation>().front();
  CHECK(violation.breach == qos_breach::gap);
  CHECK(violation.session == running);
  CHECK(violation.at == time_point{100ms + 1ns});
}

TEST_CASE_FIXTURE(watchdog_world,
                  "a gap in which results of no use came is implausible; one "
                  "after a good result is a gap") {
  tell(dog, running, now());
  run_for(50ms);
  tell(dog, running, std::string{"place value=1.000 limit=0.500"},
       std::string{"place"});
  SUBCASE("of no use until the end") {
    run_for(51ms);
    REQUIRE(requester->count<qos_violation>() == 1);
    const auto violation = requester->all<qos_violation>().front();
    CHECK(violation.breach == qos_breach::implausible);
    CHECK(violation.why == "place value=1.000 limit=0.500");
    CHECK(violation.check == "place");
  }
  SUBCASE("good in the end") {
    arrive();
    run_for(101ms);
    REQUIRE(requester->count<qos_violation>() == 1);
    const auto violation = requester->all<qos_violation>().front();
    CHECK(violation.breach == qos_breach::gap);
    CHECK(violation.why.starts_with("qos_gap value_ms=100.000001 "));
  }
}

TEST_CASE_FIXTURE(watchdog_world,
                  "results at exactly the longest gap keep the watchdog calm") {
  tell(dog, running, now());
  for (int k = 0; k < 50; ++k) {
    run_for(100ms);
    arrive();
  }
  CHECK(requester->count<qos_violation>() == 0);
  run_for(101ms);
  CHECK(requester->count<qos_violation>() == 1);
}

TEST_CASE_FIXTURE(watchdog_world,
                  "a result that comes too late is a violation") {
  tell(dog, running, now());
  run_for(50ms);
  arrive(50ms);
  CHECK(requester->count<qos_violation>() == 0);
  arrive(50ms + 1ns);
  REQUIRE(requester->count<qos_violation>() == 1);
  CHECK(requester->all<qos_violation>().front().breach == qos_breach::latency);
}

TEST_CASE_FIXTURE(watchdog_world,
                  "the watchdog barks once per running service") {
  tell(dog, running, now());
  run_for(10s);
  arrive(1s);
  CHECK(requester->count<qos_violation>() == 1);
}

TEST_CASE_FIXTURE(
    watchdog_world,
    "after service_end the watchdog is silent, and can be armed again") {
  tell(dog, running, now());
  tell(dog, service_end{running});
  run_for(1s);
  CHECK(requester->count<qos_violation>() == 0);
  tell(dog, running, now());
  run_for(1s);
  CHECK(requester->count<qos_violation>() == 1);
}

TEST_CASE_FIXTURE(watchdog_world,
                  "arrivals of another running service do not count") {
  tell(dog, running, now());
  auto other = running;
  other.counter = 8;
  run_for(60ms);
  tell(dog, arrival{other, now() - 1s, now()});
  run_for(41ms);
  REQUIRE(requester->count<qos_violation>() == 1);
  CHECK(requester->all<qos_violation>().front().breach == qos_breach::gap);
}
