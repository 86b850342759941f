// Tests of service management in the vehicle: which source is used, when.
#include "actors/offloading/service_manager.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <optional>
#include <utility>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

/// Understands echoes alone, and believes as they do.
struct echo_judge final : offloading::result_judge {
  std::unique_ptr<offloading::result_judge> believes =
      echo_in_vehicle{}.make_judge();

  offloading::judged_result judge(const payload& result,
                                  const service_input& latest,
                                  time_point now) override {
    if (!result.as<echo>())
      return {};
    return believes->judge(result, latest, now);
  }
};

/// An echo that is told whether it says ITS messages on the air.
struct quiet_echo final : echo_in_vehicle {
  std::shared_ptr<echo_in_vehicle> speaks;

  service_input encode_input(service_input input,
                             bool takes_over) const override {
    return speaks ? speaks->encode_input(std::move(input), takes_over)
                  : echo_in_vehicle::encode_input(std::move(input), takes_over);
  }
  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return std::make_unique<echo_judge>();
  }
};

/// A manager whose local service runs every 50 ms and takes 5 ms; its clients
/// and peers are probes.
struct managed_world : virtual_world {
  const session_id running{1, 101, "echo", 7};
  const session_id next_running{1, 101, "echo", 8};
  std::shared_ptr<quiet_echo> service = std::make_shared<quiet_echo>();
  probe<client_actor> client = listen<client_actor>();
  probe<onboard_requester_actor> requester = listen<onboard_requester_actor>();
  probe<recorder_actor> recorder = listen<recorder_actor>();
  probe<provider_manager_actor> there = listen<provider_manager_actor>();
  requester_manager_actor manager = spawn();

  managed_world() { settle(); }

  requester_manager_actor spawn() {
    requester_manager_setup setup;
    setup.station = 101;
    setup.service = {"echo", echo_options(), service};
    setup.local.session = {0, 101, "echo", 0};
    setup.local.function = service->make_function();
    setup.local.period = 50ms;
    setup.local.finish = [](time_point start, std::uint64_t) {
      return start + 5ms;
    };
    setup.client = client.handle;
    setup.requester = requester.handle;
    setup.recorder = recorder.handle;
    return own(spawn_requester_manager(system(), std::move(setup)));
  }

  void feed(std::uint64_t number) {
    tell(manager, service_input{{}, now(), payload::of(echo{number})});
  }
  void accept(const session_id& r) { tell(manager, r, there.handle); }
  void result(std::uint64_t cycle, duration latency = 10ms) {
    result_of(running, cycle, latency);
  }
  void result_of(const session_id& r, std::uint64_t cycle,
                 duration latency = 10ms) {
    tell(manager, service_result{r, cycle, now() - latency,
                                 payload::of(echo{1000 + cycle})});
  }
  void uncertain_result(std::uint64_t cycle, duration doubt) {
    tell(manager, service_result{running,
                                 cycle,
                                 now() - 10ms,
                                 payload::of(echo{1000 + cycle}),
                                 {},
                                 doubt});
  }
  void end() { tell(manager, service_end{running}); }

  /// Runs until the remote source is in use.
  void go_remote() {
    feed(1);
    run_for(1s);
    accept(running);
    result(1);
    REQUIRE(source() == true);
  }

  /// @returns whether the remote source is in use, if it ever changed.
  std::optional<bool> source() const {
    const auto changes = client->all<source_change>();
    return changes.empty() ? std::nullopt
                           : std::optional{changes.back().remote};
  }
  std::size_t results(bool remote) const {
    std::size_t n = 0;
    for (const auto& r : client->all<service_result>())
      n += r.session.is_remote() == remote;
    return n;
  }
};

} // namespace

TEST_CASE_FIXTURE(managed_world,
                  "the manager tells its client where inputs are wanted") {
  REQUIRE(client->count<requester_manager_actor>() == 1);
  CHECK(client->all<requester_manager_actor>().front() == manager);
}

TEST_CASE_FIXTURE(managed_world, "at first the local service is used") {
  feed(1);
  run_for(1s);
  CHECK(results(false) == 19); // that of 1 s is under way
  CHECK(!source());
  for (const auto& r : client->all<service_result>()) {
    CHECK(r.session == session_id{0, 101, "echo", 0});
    CHECK(r.what.as<echo>()->number == 1);
  }
}

TEST_CASE_FIXTURE(managed_world,
                  "acceptance alone leaves the local service in use") {
  feed(1);
  accept(running);
  run_for(900ms);
  CHECK(!source());
  CHECK(results(false) == 17);
  CHECK(requester->entries().empty());
}

TEST_CASE_FIXTURE(managed_world,
                  "a running service is fed with what is newest at once") {
  feed(1);
  feed(2);
  run_for(70ms);
  accept(running);
  REQUIRE(there->count<service_input>() == 1);
  const auto input = there->all<service_input>().front();
  CHECK(input.session == running);
  CHECK(input.at == time_point{});
  CHECK(input.what.as<echo>()->number == 2);
}

TEST_CASE_FIXTURE(managed_world,
                  "without any input there is nothing to feed it with") {
  accept(running);
  CHECK(there->count<service_input>() == 0);
  run_for(10ms);
  feed(1);
  CHECK(there->count<service_input>() == 1);
}

TEST_CASE_FIXTURE(managed_world, "with the first remote result the source "
                                 "changes, before the result itself") {
  feed(1);
  run_for(1s);
  accept(running);
  client->clear();
  result(1);
  REQUIRE(client->entries().size() == 2);
  REQUIRE(client->count<source_change>() == 1);
  CHECK(client->entries()[0].what.type_at(0) == caf::type_id_v<source_change>);
  CHECK(client->all<source_change>().front().service == service_name{"echo"});
  CHECK(source() == true);
  REQUIRE(client->count<service_result>() == 1);
  CHECK(client->all<service_result>().front().session == running);
  for (const auto& e : client->entries())
    CHECK(e.at == now());
}

TEST_CASE_FIXTURE(managed_world,
                  "with the first remote result the requester is told, once") {
  go_remote();
  REQUIRE(requester->count<session_id>() == 1);
  CHECK(requester->all<session_id>().front() == running);
  CHECK(requester->times<session_id>().front() == now());
  result(2);
  CHECK(requester->count<session_id>() == 1);
}

TEST_CASE_FIXTURE(managed_world, "while the remote source is in use, the local "
                                 "service gives nothing") {
  go_remote();
  const auto before = results(false);
  for (std::uint64_t k = 2; k <= 20; ++k) {
    run_for(50ms);
    result(k);
  }
  CHECK(results(false) == before);
  CHECK(results(true) == 20);
}

TEST_CASE_FIXTURE(managed_world,
                  "a local cycle under way when the source changes is not "
                  "used any more") {
  feed(1);
  run_for(1s);
  accept(running);
  run_for(2ms); // a local cycle began at 1 s and takes 5 ms
  const auto before = results(false);
  result(1);
  run_for(50ms);
  CHECK(results(false) == before);
}

TEST_CASE_FIXTURE(managed_world,
                  "the first remote result arms the watchdog for the gap") {
  go_remote();
  run_for(100ms);
  CHECK(requester->count<qos_violation>() == 0);
  run_for(1ns);
  REQUIRE(requester->count<qos_violation>() == 1);
  CHECK(requester->all<qos_violation>().front().session == running);
}

TEST_CASE_FIXTURE(managed_world,
                  "every further result winds the watchdog up again") {
  go_remote();
  for (std::uint64_t k = 2; k <= 30; ++k) {
    run_for(100ms);
    result(k);
  }
  CHECK(requester->count<qos_violation>() == 0);
}

TEST_CASE_FIXTURE(managed_world,
                  "a first result that is late by a nanosecond is not used") {
  feed(1);
  run_for(1s);
  accept(running);
  result(1, 50ms + 1ns);
  run_for(500ms);
  CHECK(!source());
  CHECK(results(true) == 0);
  CHECK(results(false) == 29);
  CHECK(requester->entries().empty()); // no violation either
  REQUIRE(recorder->count<cycle_record>() == 1);
  CHECK(!recorder->all<cycle_record>().front().used);
}

TEST_CASE_FIXTURE(managed_world, "after a late first result, one exactly in "
                                 "time is the first that is used") {
  feed(1);
  run_for(1s);
  accept(running);
  result(1, 60ms);
  run_for(50ms);
  result(2, 50ms);
  CHECK(source() == true);
  CHECK(results(true) == 1);
}

TEST_CASE_FIXTURE(managed_world, "a late result is a violation, not a result") {
  go_remote();
  run_for(50ms);
  result(2, 50ms + 1ns);
  CHECK(results(true) == 1);
  REQUIRE(requester->count<qos_violation>() == 1);
  CHECK(requester->all<qos_violation>().front().breach == qos_breach::latency);
}

TEST_CASE_FIXTURE(managed_world,
                  "results that come twice or out of order are not used") {
  go_remote();
  run_for(50ms);
  result(3);
  result(3);
  result(2);
  result(1);
  CHECK(results(true) == 2);
  CHECK(recorder->count<cycle_record>() == 2);
}

TEST_CASE_FIXTURE(managed_world, "results that come twice or out of order do "
                                 "not wind the watchdog up") {
  go_remote();
  run_for(60ms);
  result(1);
  run_for(40ms + 1ns);
  CHECK(requester->count<qos_violation>() == 1);
}

TEST_CASE_FIXTURE(managed_world, "results that nobody understands are as if "
                                 "they had not come") {
  const auto nonsense = [&](std::uint64_t cycle) {
    tell(manager, service_result{running, cycle, now() - 10ms,
                                 payload::of(its_pdu{{std::byte{1}}})});
  };
  feed(1);
  run_for(1s);
  accept(running);
  nonsense(1);
  run_for(100ms);
  CHECK(!source()); // the local service plans on
  result(2);
  CHECK(source() == true);
  for (std::uint64_t k = 3; k < 13; ++k) {
    run_for(10ms);
    nonsense(k);
  }
  CHECK(requester->count<qos_violation>() == 0);
  run_for(1ns);
  CHECK(requester->count<qos_violation>() == 1); // of the gap
  CHECK(results(true) == 1);
}

TEST_CASE_FIXTURE(managed_world,
                  "results of another running service are not used") {
  go_remote();
  run_for(10ms);
  result_of({1, 101, "echo", 6}, 2);
  result_of({2, 101, "echo", 7}, 2);
  CHECK(results(true) == 1);
  end();
  result_of(running, 3);
  CHECK(results(true) == 1);
  CHECK(source() == false);
}

TEST_CASE_FIXTURE(managed_world,
                  "when the service ends the local one plans at once") {
  go_remote();
  run_for(63ms); // off the local grid
  feed(42);
  client->clear();
  end();
  REQUIRE(client->count<source_change>() == 1);
  CHECK(client->times<source_change>().front() == now());
  CHECK(source() == false);
  const auto ended = now();
  run_for(5ms);
  REQUIRE(client->count<service_result>() == 1);
  const auto first = client->all<service_result>().front();
  CHECK(first.created == ended);
  CHECK(!first.session.is_remote());
  CHECK(first.what.as<echo>()->number == 42);
}

TEST_CASE_FIXTURE(managed_world, "after the end the watchdog is silent") {
  go_remote();
  end();
  run_for(10s);
  CHECK(requester->count<qos_violation>() == 0);
}

TEST_CASE_FIXTURE(managed_world, "ending twice changes nothing") {
  go_remote();
  run_for(63ms);
  end();
  client->clear();
  end();
  run_for(1s);
  CHECK(client->count<source_change>() == 0);
  CHECK(results(false) <= 21);
}

TEST_CASE_FIXTURE(managed_world, "the end of another running service does not "
                                 "concern the one in use") {
  go_remote();
  tell(manager, service_end{next_running});
  CHECK(source() == true);
  run_for(50ms);
  result(2);
  CHECK(results(true) == 2);
}

TEST_CASE_FIXTURE(managed_world,
                  "a service that ends before its first result was never a "
                  "source") {
  feed(1);
  accept(running);
  run_for(1s);
  end();
  result(1);
  run_for(1s);
  CHECK(!source());
  CHECK(results(true) == 0);
  CHECK(results(false) == 39);
}

TEST_CASE_FIXTURE(managed_world, "the next running service starts afresh") {
  go_remote();
  end();
  run_for(1s);
  accept(next_running);
  CHECK(source() == false);
  result_of(next_running, 1); // cycles may start anywhere again
  CHECK(source() == true);
  CHECK(requester->all<session_id>().back() == next_running);
}

TEST_CASE_FIXTURE(managed_world,
                  "on the air inputs are decimated, at home they are not") {
  feed(1);
  accept(running);
  for (std::uint64_t k = 2; k <= 51; ++k) { // for 1 s
    run_for(20ms);
    feed(k);
  }
  CHECK(there->count<service_input>() == 11);
  const auto times = there->times<service_input>();
  for (std::size_t k = 1; k < times.size(); ++k)
    CHECK(times[k] - times[k - 1] >= 100ms);
  run_for(55ms);
  CHECK(client->all<service_result>().back().what.as<echo>()->number == 51);
}

TEST_CASE_FIXTURE(managed_world, "what crosses the air is what the service "
                                 "says there, recorded as it leaves") {
  service->speaks = std::make_shared<its_echo_in_vehicle>();
  feed(1);
  run_for(1s);
  CHECK(recorder->count<air_record>() == 0);
  accept(running);
  run_for(100ms);
  feed(2);
  result(1); // the provider takes over
  run_for(100ms);
  feed(3);
  const auto inputs = there->all<service_input>();
  const auto records = recorder->all<air_record>();
  REQUIRE(inputs.size() == 3);
  REQUIRE(records.size() == 3);
  const std::array<std::pair<std::uint64_t, bool>, 3> said{
      {{1, true}, {2, true}, {3, false}}};
  for (std::size_t k = 0; k < 3; ++k) {
    REQUIRE(inputs[k].what.as<its_pdu>());
    const auto expected = its_octets(said[k].first, said[k].second);
    CHECK(inputs[k].what.as<its_pdu>()->octets
          == expected.as<its_pdu>()->octets);
    CHECK(records[k].message.octets == expected.as<its_pdu>()->octets);
    CHECK(records[k].at == there->times<service_input>()[k]);
  }
  // At home it stays as it is.
  CHECK(client->all<service_result>().front().what.as<echo>());
}

TEST_CASE_FIXTURE(managed_world, "who takes over is told of the result in "
                                 "use, who goes on is not") {
  go_remote();
  const auto first = there->all<service_input>().front();
  REQUIRE(first.in_use.as<echo>());
  CHECK(first.in_use.as<echo>()->number == 1);
  run_for(100ms);
  feed(2);
  CHECK(there->all<service_input>().back().in_use.type().empty());
}

TEST_CASE_FIXTURE(managed_world, "a service that has ended is not fed") {
  go_remote();
  end();
  there->clear();
  run_for(1s);
  feed(2);
  CHECK(there->count<service_input>() == 0);
}

TEST_CASE_FIXTURE(managed_world, "every received result is recorded, with the "
                                 "time since the one before") {
  go_remote();
  run_for(70ms);
  result(2, 20ms);
  run_for(30ms);
  result(3, 51ms);
  const auto records = recorder->all<cycle_record>();
  REQUIRE(records.size() == 3);
  CHECK(!records[0].interarrival);
  CHECK(records[1].interarrival == 70ms);
  CHECK(records[1].received == time_point{1070ms});
  CHECK(records[1].created == time_point{1050ms});
  CHECK(records[1].cycle == 2);
  CHECK(records[1].session == running);
  CHECK(records[1].used);
  CHECK(records[2].interarrival == 30ms);
  CHECK(!records[2].used);
}

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
  go_remote();
  CHECK(recorder->count<event_record>() == 0);
  std::uint64_t cycle = 1;
  for (int k = 0; k < 5; ++k)
    uncertain_result(++cycle, 30ms);
  REQUIRE(recorder->count<event_record>() == 1);
  const auto doubt = recorder->all<event_record>().front();
  CHECK(doubt.what == event_type::clock_in_doubt);
  CHECK(doubt.at == now());
  CHECK(doubt.station == 101);
  CHECK(doubt.provider == 1);
  CHECK(doubt.service == service_name{"echo"});
  CHECK(doubt.counter == 7);
  CHECK(doubt.detail == "30.0 ms");
  for (int k = 0; k < 5; ++k)
    uncertain_result(++cycle, 1ms);
  REQUIRE(recorder->count<event_record>() == 2);
  CHECK(recorder->all<event_record>().back().what == event_type::clock_known);
  uncertain_result(++cycle, 30ms);
  CHECK(recorder->all<event_record>().back().what
        == event_type::clock_in_doubt);
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
