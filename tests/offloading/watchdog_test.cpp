// When the results of a session are late or missing.
#include "offloading/watchdog.hpp"

#include "tests/support/at.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::messages;
using namespace std::chrono_literals;
using test::at;

namespace {

const session_id session{1, 101, "trajectory_planning", 7};
const session_id other{2, 101, "trajectory_planning", 8};

struct armed_watchdog {
  offloading::watchdog dog{{50ms, 100ms}};

  armed_watchdog() { dog.arm(session, at(1s)); }

  auto result(duration received, duration latency = 10ms,
              const session_id& of = session) {
    return dog.on_arrival({of, at(received) - latency, at(received)},
                          at(received));
  }
};

} // namespace

TEST_CASE("a watchdog that watches nothing has no deadline and finds nothing") {
  offloading::watchdog dog{{50ms, 100ms}};
  CHECK_FALSE(dog.deadline());
  CHECK_FALSE(dog.on_deadline(at(10s)));
  CHECK_FALSE(dog.on_arrival({session, at(1s), at(9s)}, at(9s)));
}

TEST_CASE_FIXTURE(armed_watchdog, "a gap is found one nanosecond past its "
                                  "limit, and only once") {
  REQUIRE(dog.deadline() == at(1100ms + 1ns));
  CHECK_FALSE(dog.on_deadline(at(1100ms)));
  const auto found = dog.on_deadline(at(1100ms + 1ns));
  REQUIRE(found);
  CHECK(found->session == session);
  CHECK(found->breach == qos_breach::gap);
  CHECK(found->at == at(1100ms + 1ns));
  CHECK_FALSE(dog.deadline());
  CHECK_FALSE(dog.on_deadline(at(2s)));
}

TEST_CASE_FIXTURE(armed_watchdog, "every result of the session moves the "
                                  "deadline, no other result does") {
  CHECK_FALSE(result(1090ms));
  CHECK(dog.deadline() == at(1190ms + 1ns));
  CHECK_FALSE(result(1150ms, 10ms, other));
  CHECK(dog.deadline() == at(1190ms + 1ns));
}

TEST_CASE_FIXTURE(armed_watchdog, "a result later than allowed is a violation, "
                                  "after which the session is not watched") {
  CHECK_FALSE(result(1050ms, 50ms));
  const auto found = result(1100ms, 50ms + 1ns);
  REQUIRE(found);
  CHECK(found->breach == qos_breach::latency);
  CHECK_FALSE(result(1150ms, 60ms));
  CHECK_FALSE(dog.deadline());
}

TEST_CASE_FIXTURE(armed_watchdog, "a gap in which results came that could not "
                                  "be used is implausible") {
  dog.on_useless(session, {"place value=1.000 limit=0.500", "place"});
  SUBCASE("until its end") {
    const auto found = dog.on_deadline(at(2s));
    REQUIRE(found);
    CHECK(found->breach == qos_breach::implausible);
    CHECK(found->why == "place value=1.000 limit=0.500");
    CHECK(found->check == "place");
  }
  SUBCASE("but not after one that could") {
    CHECK_FALSE(result(1050ms));
    const auto found = dog.on_deadline(at(2s));
    REQUIRE(found);
    CHECK(found->breach == qos_breach::gap);
    CHECK(found->why == "qos_gap value_ms=950.000000 limit_ms=100.000000");
    CHECK(found->check.empty());
  }
  SUBCASE("of this session, not of another one") {
    dog.arm(session, at(1s));
    dog.on_useless(other, {"place", "place"});
    CHECK(dog.on_deadline(at(2s))->breach == qos_breach::gap);
  }
}

TEST_CASE_FIXTURE(armed_watchdog, "only the session that is watched can be "
                                  "disarmed") {
  CHECK_FALSE(dog.disarm(other));
  CHECK(dog.deadline());
  CHECK(dog.disarm(session));
  CHECK_FALSE(dog.deadline());
}

TEST_CASE("a result in time is a violation if its input is too old by then, "
          "which the violation tells with value and limit") {
  offloading::watchdog dog{{50ms, 100ms, 500ms}};
  const auto result = [&dog](duration age) {
    dog.arm(session, at(1s));
    const auto t = at(1050ms);
    return dog.on_arrival({session, t - 10ms, t, t - age}, t);
  };
  CHECK_FALSE(result(500ms));
  const auto found = result(500ms + 1ns);
  REQUIRE(found);
  CHECK(found->breach == qos_breach::input_age);
  CHECK(found->why == "qos_input_age value_ms=500.000001 limit_ms=500.000000");
  CHECK_FALSE(dog.deadline());
  CHECK(result(-1ns)); // of an input that is still to come
}

TEST_CASE_FIXTURE(armed_watchdog, "a violation tells its value and the limit") {
  CHECK(result(1050ms, 61200us)->why
        == "qos_latency value_ms=61.200000 limit_ms=50.000000");
  dog.arm(session, at(2s));
  CHECK(dog.on_deadline(at(2600ms))->why
        == "qos_gap value_ms=600.000000 limit_ms=100.000000");
}

TEST_CASE_FIXTURE(armed_watchdog, "limits that become narrower or wider hold "
                                  "from then on, and gaps go on") {
  CHECK_FALSE(result(1050ms, 50ms));
  dog.limit({20ms, 100ms});
  CHECK(dog.deadline() == at(1150ms + 1ns));
  CHECK_FALSE(result(1100ms, 20ms));
  dog.limit({40ms, 100ms});
  CHECK_FALSE(result(1120ms, 40ms));
  dog.limit({30ms, 100ms});
  const auto found = result(1130ms, 40ms);
  REQUIRE(found);
  CHECK(found->breach == qos_breach::latency);
  CHECK(found->why == "qos_latency value_ms=40.000000 limit_ms=30.000000");
}
