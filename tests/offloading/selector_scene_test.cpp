// Whose results a vehicle uses when its scene says how late they may be.
#include "tests/offloading/selector_diary.hpp"
#include "tests/support/at.hpp"
#include "tests/support/echo.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <optional>

using namespace sofof;
using namespace sofof::messages;
using namespace std::chrono_literals;
using namespace test::numbers_service;
using offloading::source_selector;
using test::at;
using test::echo;

namespace {

/// Numbers that are milliseconds under which the scene is safe; 0: unknown.
struct numbers_of_a_scene final : offloading::vehicle_service {
  explicit numbers_of_a_scene(duration its_age = {}) : age{its_age} {}

  std::shared_ptr<offloading::service_function> make_function() const override {
    return nullptr;
  }
  std::optional<offloading::safe_response>
  look_at_scene(const service_input& latest) const override {
    const auto number = latest.what.as<echo>()->number;
    if (number == 0)
      return std::nullopt;
    return offloading::safe_response{std::chrono::milliseconds{number},
                                     "follow", age};
  }

  duration age; // of the scene, when an input is made of it
};

/// A service whose scene says how late its results may be: 50 ms at most, 20 ms
/// at least; 100 ms are left for a gap.
struct limited_by_scene {
  const session_id own{0, 101, "numbers", 0}, a{1, 101, "numbers", 7};
  diary port;
  source_selector selector;
  std::uint64_t cycle = 0;

  static offloading::selector_setup setup(duration age) {
    auto made = numbers_setup();
    made.service.own = std::make_shared<numbers_of_a_scene>(age);
    made.service.options.latency_by_scene = true;
    made.service.options.latency_floor = 20ms;
    return made;
  }
  explicit limited_by_scene(duration age = {}) : selector{setup(age), port} {}

  lines scene(int safe_ms, duration t) {
    port.lines.clear();
    selector.on_input({own, at(t), of(static_cast<std::uint64_t>(safe_ms))},
                      at(t));
    std::erase(port.lines, "feed A");
    return port.lines;
  }
  lines result(duration t, duration latency) {
    port.lines.clear();
    selector.on_result({.session = a,
                        .cycle = ++cycle,
                        .created = at(t) - latency,
                        .what = of(1),
                        .timing = {.input_at = at(t) - latency}},
                       at(t));
    return port.lines;
  }
  void begin() {
    scene(2000, 0s);
    selector.on_session(a, at(10ms));
    result(30ms, 10ms);
    REQUIRE(selector.is_remote());
  }
};

} // namespace

TEST_CASE("at each input it is told under which response time the scene is "
          "safe, where somebody asks and the service knows") {
  for (const auto asked : {false, true}) {
    auto setup = numbers_setup();
    setup.service.own = std::make_shared<numbers_of_a_scene>();
    setup.asks_scene = asked;
    diary port;
    source_selector selector{setup, port};
    const session_id own{0, 101, "numbers", 0};
    selector.on_input({own, at(0s), of(0)}, at(0s));
    CHECK(!port.safe);
    service_result first{own, 1, at(20ms), of(1)};
    first.timing.input_at = at(0s);
    selector.on_result(first, at(25ms));
    selector.on_input({own, at(50ms), of(700)}, at(50ms));
    CHECK(port.safe == (asked ? std::optional<duration>{700ms} : std::nullopt));
    CHECK(port.scenes.size() == (asked ? 1 : 0));
    for (const auto& seen : port.scenes) {
      CHECK(seen.safe == 700ms);
      CHECK(seen.because == "follow");
      CHECK(seen.response == 50ms);
    }
  }
}

TEST_CASE_FIXTURE(limited_by_scene, "where the scene says how late results may "
                                    "be, the watchdog hears of each change, "
                                    "and never of more than the cap") {
  begin();
  CHECK(scene(1000, 50ms).empty());
  CHECK(scene(140, 100ms) == lines{"limits: 40 ms, input 40 ms"});
  CHECK(scene(140, 150ms).empty());
  CHECK(result(160ms, 40ms) == lines{"use A"});
  CHECK(result(170ms, 41ms) == lines{"result_refused"});
  CHECK(port.detail.starts_with("latency value_ms=41"));
  CHECK(scene(900, 200ms) == lines{"limits: 50 ms, input 500 ms"});
  CHECK(result(210ms, 41ms) == lines{"use A"});
}

TEST_CASE("a scene that was sensed before its input leaves so much less") {
  limited_by_scene x{30ms};
  x.begin();
  CHECK(x.scene(170, 50ms) == lines{"limits: 40 ms, input 40 ms"});
  CHECK(x.scene(149, 100ms).back() == "violation: A");
  CHECK(x.port.safe == 149ms); // policies add up the times of the chain
}

TEST_CASE_FIXTURE(limited_by_scene, "a scene that allows for no result brings "
                                    "the service home at once, and lets none "
                                    "begin") {
  begin();
  CHECK(scene(120, 50ms) == lines{"limits: 20 ms, input 20 ms"});
  CHECK(scene(119, 100ms)
        == lines{"watch nothing", "own function plans on", "source: local",
                 "violation: A"});
  CHECK_FALSE(selector.is_remote());
  selector.on_session(a, at(110ms));
  CHECK(result(120ms, 1ms) == lines{"result_refused"});
  CHECK_FALSE(selector.is_remote());
  CHECK(scene(150, 150ms) == lines{"limits: 50 ms, input 50 ms"});
  result(160ms, 10ms);
  CHECK(selector.is_remote());
}
