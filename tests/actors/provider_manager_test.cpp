// Tests of service management at the provider, for one accepted service.
#include "actors/offloading/service_manager.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

struct provider_manager_world : virtual_world {
  const session_id running{1, 101, "echo", 7};
  probe<requester_actor> requester = listen<requester_actor>();
  probe<provider_actor> provider = listen<provider_actor>();
  probe<recorder_actor> recorder = listen<recorder_actor>();
  // Lives as long as the instance.
  std::weak_ptr<offloading::service_function> function;
  provider_manager_actor manager = spawn();

  provider_manager_actor spawn() {
    offloading::cycle_setup setup;
    setup.session = running;
    setup.function = std::make_shared<echo_function>();
    setup.period = 50ms;
    setup.phase = 20ms;
    setup.finish = [](time_point start, std::uint64_t) { return start + 3ms; };
    function = setup.function;
    return own(
        spawn_provider_manager(system(), {std::move(setup), requester.handle,
                                          provider.handle, recorder.handle}));
  }

  void feed(std::uint64_t number) {
    tell(manager, service_input{running, now(), payload::of(echo{number})});
  }
};

} // namespace

TEST_CASE_FIXTURE(provider_manager_world,
                  "an accepted service waits for its first input") {
  run_for(999ms);
  CHECK(requester->entries().empty());
  CHECK(!is_gone(manager));
}

TEST_CASE_FIXTURE(provider_manager_world,
                  "an accepted service that nobody feeds is given up after the "
                  "start time-out") {
  run_for(1s);
  CHECK(is_gone(manager));
}

TEST_CASE_FIXTURE(provider_manager_world,
                  "a service that was fed once is not given up") {
  feed(1);
  run_for(10s);
  CHECK(!is_gone(manager));
}

TEST_CASE_FIXTURE(provider_manager_world,
                  "with the first input the service runs at once, then on its "
                  "grid, and its results go to the requester") {
  run_for(100ms);
  feed(1);
  run_for(75ms);
  const auto results = requester->all<service_result>();
  REQUIRE(results.size() == 3);
  CHECK(results[0].created == time_point{100ms});
  CHECK(results[1].created == time_point{120ms});
  CHECK(results[2].created == time_point{170ms});
  CHECK(results[0].cycle < results[1].cycle);
  for (const auto& r : results)
    CHECK(r.session == running);
  CHECK(requester->times<service_result>().front() == time_point{103ms});
}

TEST_CASE_FIXTURE(provider_manager_world, "further input replaces the older, "
                                          "and does not start further cycles") {
  run_for(20ms);
  feed(1);
  run_for(10ms);
  feed(2);
  feed(3);
  run_for(90ms);
  const auto results = requester->all<service_result>();
  REQUIRE(results.size() == 2); // of 20 ms and 70 ms
  CHECK(results[0].what.as<echo>()->number == 1);
  CHECK(results[1].what.as<echo>()->number == 3);
}

TEST_CASE_FIXTURE(provider_manager_world,
                  "results that are ITS messages are recorded as they leave") {
  feed(1);
  run_for(10ms);
  CHECK(recorder->count<air_record>() == 0); // an echo is none
  const its_pdu said{{std::byte{7}}};
  tell(manager, service_input{running, now(), payload::of(said)});
  requester->clear();
  run_for(100ms);
  const auto records = recorder->all<air_record>();
  REQUIRE(records.size() == 2);
  CHECK(requester->count<service_result>() == 2);
  for (const auto& r : records)
    CHECK(r.message.octets == said.octets);
  CHECK(records.front().at == requester->times<service_result>().front());
}

TEST_CASE_FIXTURE(provider_manager_world,
                  "at its end the service is finalized and the manager quits") {
  feed(1);
  run_for(1s);
  tell(manager, service_end{running});
  CHECK(is_gone(manager));
  CHECK(function.expired());
  requester->clear();
  run_for(1s);
  CHECK(requester->entries().empty());
}

TEST_CASE_FIXTURE(provider_manager_world,
                  "a service that never had input ends just as well") {
  tell(manager, service_end{running});
  CHECK(is_gone(manager));
  CHECK(function.expired());
}

TEST_CASE_FIXTURE(provider_manager_world,
                  "the manager does not outlive its provider") {
  feed(1);
  run_for(1s);
  kill(provider.handle);
  CHECK(is_gone(manager));
  CHECK(function.expired());
  requester->clear();
  run_for(1s);
  CHECK(requester->entries().empty());
}

TEST_CASE_FIXTURE(provider_manager_world,
                  "the instance does not outlive its manager") {
  feed(1);
  run_for(1s);
  kill(manager);
  CHECK(function.expired());
}
