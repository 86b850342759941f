// Tests of service management in the vehicle: which source is used, when.
#include "tests/actors/managed_world.hpp"

#include <array>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

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

namespace {

struct warm_manager : managed_world {
  warm_manager() : managed_world{2s} {}
};

} // namespace

TEST_CASE_FIXTURE(warm_manager, "an own function that runs along has a result "
                                "in the instant in which the provider ends") {
  go_remote();
  client->clear();
  for (std::uint64_t k = 2; k < 6; ++k) {
    run_for(50ms);
    feed(k);
    result(k);
  }
  CHECK(results(false) == 0); // nothing of it is used before
  run_for(10ms);
  client->clear();
  end();
  REQUIRE(client->entries().size() == 2);
  CHECK(client->entries()[0].what.type_at(0) == caf::type_id_v<source_change>);
  REQUIRE(results(false) == 1);
  CHECK(client->all<service_result>().front().what.as<echo>()->number == 5);
  for (const auto& e : client->entries())
    CHECK(e.at == now());
  run_for(50ms);
  CHECK(results(false) >= 2); // and it goes on
}

TEST_CASE_FIXTURE(warm_manager, "after its time the own function rests, and "
                                "runs along again when a change home is "
                                "foreseen") {
  go_remote();
  std::uint64_t k = 2;
  const auto drive = [&](duration d) {
    for (const auto end = now() + d; now() < end; ++k) {
      run_for(50ms);
      feed(k);
      result(k);
    }
  };
  const auto along = [&] {
    std::uint64_t sum = 0;
    for (const auto& x : recorder->all<record>())
      if (const auto* work = std::get_if<work_record>(&x))
        sum += work->along;
    return sum;
  };
  drive(4s);
  const auto after_change = along();
  CHECK(after_change >= 38); // 2 s of 50 ms
  CHECK(after_change <= 42);
  drive(2s);
  CHECK(along() == after_change);
  tell(manager, home_is_near_atom_v);
  drive(4s);
  CHECK(along() >= after_change + 38);
  CHECK(along() <= after_change + 42);
  CHECK(source() == true);
}
