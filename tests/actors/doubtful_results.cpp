// Tests of results whose age is uncertain or whose content is implausible, as
// service management in the vehicle hears them.
#include "tests/actors/managed_world.hpp"

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

// -- clocks ------------------------------------------------------------------

TEST_CASE_FIXTURE(managed_world, "a result whose age is uncertain by more than "
                                 "half of the limit is not used") {
  feed(1);
  run_for(1s);
  accept(running);
  uncertain_result(1, 25ms + 1ns);
  CHECK(!source());
  CHECK(results(true) == 0);
  uncertain_result(2, 25ms);
  CHECK(source() == true);
  CHECK(results(true) == 1);
  run_for(50ms);
  uncertain_result(3, 26ms);
  CHECK(results(true) == 1);
  const auto records = recorder->all<cycle_record>();
  REQUIRE(records.size() == 3);
  CHECK(!records[0].used);
  CHECK(records[1].used);
  CHECK(!records[2].used);
  CHECK(records[0].doubt == 25ms + 1ns);
}

TEST_CASE_FIXTURE(managed_world,
                  "who gets nothing but uncertain results from a "
                  "source in use is warned of a gap") {
  go_remote();
  for (std::uint64_t cycle = 2; cycle < 12; ++cycle) {
    run_for(20ms);
    uncertain_result(cycle, 30ms);
  }
  CHECK(results(true) == 1);
  REQUIRE(requester->count<qos_violation>() > 0);
  CHECK(requester->all<qos_violation>().front().breach == qos_breach::gap);
}

TEST_CASE_FIXTURE(managed_world, "that clocks are in doubt is noted once, and "
                                 "when they are known again") {
  const auto notes = [this] {
    auto all = recorder->all<event_record>();
    std::erase_if(all, [](const event_record& x) {
      return x.what == event_type::result_refused;
    });
    return all;
  };
  go_remote();
  CHECK(notes().empty());
  std::uint64_t cycle = 1;
  for (int k = 0; k < 5; ++k)
    uncertain_result(++cycle, 30ms);
  REQUIRE(notes().size() == 1);
  CHECK(recorder->count<event_record>() == 2); // and the first result refused
  const auto doubt = notes().front();
  CHECK(doubt.what == event_type::clock_in_doubt);
  CHECK(doubt.at == now());
  CHECK(doubt.station == 101);
  CHECK(doubt.provider == 1);
  CHECK(doubt.service == service_name{"echo"});
  CHECK(doubt.counter == 7);
  CHECK(doubt.detail == "30.0 ms");
  for (int k = 0; k < 5; ++k)
    uncertain_result(++cycle, 1ms);
  REQUIRE(notes().size() == 2);
  CHECK(notes().back().what == event_type::clock_known);
  uncertain_result(++cycle, 30ms);
  CHECK(notes().back().what == event_type::clock_in_doubt);
}

TEST_CASE_FIXTURE(managed_world,
                  "an implausible result is not used; the local service plans "
                  "in the same instant, and the requester hears why") {
  go_remote();
  run_for(20ms);
  client->clear();
  requester->clear();
  const auto t = now();
  tell(manager,
       service_result{running, 2, now(), payload::of(echo{echo::lie})});
  CHECK(results(true) == 0);
  CHECK(source() == false);
  REQUIRE(requester->count<qos_violation>() == 1);
  const auto violation = requester->all<qos_violation>().front();
  CHECK(violation.session == running);
  CHECK(violation.breach == qos_breach::implausible);
  CHECK(violation.at == t);
  CHECK(violation.why == "number value=2.000 limit=1.000");
  REQUIRE(recorder->count<cycle_record>() > 0);
  CHECK(recorder->all<cycle_record>().back().cycle == 2);
  CHECK(!recorder->all<cycle_record>().back().used);
  run_for(10ms);
  CHECK(results(false) == 1);
}

TEST_CASE_FIXTURE(managed_world,
                  "results of no use are left out; when nothing better comes "
                  "in time, that is implausible") {
  go_remote();
  run_for(20ms);
  client->clear();
  const auto tell_useless = [&](std::uint64_t cycle) {
    tell(manager, service_result{running, cycle, now(),
                                 payload::of(echo{echo::useless})});
  };
  SUBCASE("something better comes") {
    tell_useless(2);
    run_for(50ms);
    CHECK(results(true) == 0);
    result(3);
    CHECK(results(true) == 1);
    run_for(101ms);
    REQUIRE(requester->count<qos_violation>() == 1);
    CHECK(requester->all<qos_violation>().front().breach == qos_breach::gap);
  }
  SUBCASE("nothing better comes") {
    tell_useless(2);
    run_for(81ms);
    REQUIRE(requester->count<qos_violation>() == 1);
    const auto violation = requester->all<qos_violation>().front();
    CHECK(violation.breach == qos_breach::implausible);
    CHECK(violation.why == "use value=0.000 limit=1.000");
    CHECK(violation.check == "use");
  }
}

TEST_CASE_FIXTURE(managed_world,
                  "one of several that sends nothing of use for a second is "
                  "left as a liar") {
  go_remote();
  accept(next_running);
  run_for(20ms);
  result_of(next_running, 2);
  for (std::uint64_t cycle = 3; cycle < 30; ++cycle) {
    run_for(50ms);
    result_of(next_running, cycle);
    tell(manager, service_result{running, cycle, now(),
                                 payload::of(echo{echo::useless})});
  }
  REQUIRE(requester->count<qos_violation>() == 1);
  const auto violation = requester->all<qos_violation>().front();
  CHECK(violation.session == running);
  CHECK(violation.breach == qos_breach::implausible);
  CHECK(violation.check == "use");
}

TEST_CASE_FIXTURE(managed_world,
                  "an implausible first result leaves the local service in "
                  "use") {
  feed(1);
  run_for(1s);
  accept(running);
  tell(manager,
       service_result{running, 1, now(), payload::of(echo{echo::lie})});
  CHECK(!source());
  CHECK(requester->count<qos_violation>() == 1);
  result(2); // it is not heard any more
  CHECK(!source());
}

TEST_CASE_FIXTURE(managed_world, "a late result is not judged") {
  go_remote();
  run_for(20ms);
  tell(manager,
       service_result{running, 2, now() - 51ms, payload::of(echo{echo::lie})});
  CHECK(source() == true);
  REQUIRE(requester->count<qos_violation>() == 1);
  CHECK(requester->all<qos_violation>().front().breach == qos_breach::latency);
}

TEST_CASE_FIXTURE(managed_world,
                  "of two providers, the one whose result is implausible is "
                  "left, and the other one is used") {
  go_remote();
  accept(next_running);
  run_for(20ms);
  result_of(next_running, 2);
  tell(manager,
       service_result{running, 3, now(), payload::of(echo{echo::lie})});
  CHECK(source() == true);
  CHECK(requester->count<qos_violation>() == 1);
  client->clear();
  run_for(50ms);
  result_of(next_running, 4);
  CHECK(results(true) == 1);
  CHECK(results(false) == 0);
}
