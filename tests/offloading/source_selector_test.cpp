// Whose results of a service a vehicle uses, message by message, without
// actors.
#include "offloading/source_selector.hpp"

#include "base/protocol.hpp"
#include "tests/support/at.hpp"
#include "tests/support/echo.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace std::chrono_literals;
using offloading::source_selector;

using test::at;
using test::echo;

namespace {

constexpr std::uint64_t implausible = 1000, useless = 1001;

payload of(std::uint64_t number) {
  return payload::of(echo{number});
}

struct numbers_judge final : offloading::result_judge {
  offloading::judged_result judge(const payload& result, const service_input&,
                                  time_point) override {
    const auto number = result.as<echo>()->number;
    if (number == implausible)
      return {.what = {}, .refused = objection{"number", 1000, 999}};
    if (number == useless)
      return {.what = {}, .useless = objection{"number", 1001, 999}};
    return {.what = result};
  }
};

/// Numbers that may all follow each other, and cross the air as they are.
struct numbers final : offloading::vehicle_service {
  std::shared_ptr<offloading::service_function> make_function() const override {
    return nullptr; // a selector needs none
  }
  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return std::make_unique<numbers_judge>();
  }
};

offloading::selector_setup numbers_setup() {
  offloading::service_options options;
  options.limits = {50ms, 100ms, 500ms};
  options.period = 50ms;
  options.input_period = 100ms;
  return {101, {"numbers", options, std::make_shared<numbers>()}};
}

/// Writes down what a selector wants, a word or two for each call.
struct diary final : offloading::selector_port {
  std::vector<std::string> lines;
  std::string detail; ///< Of the latest event.
  std::optional<duration> safe;
  std::vector<work_record> work;
  std::vector<scene_record> scenes;

  void write(std::string line) { lines.push_back(std::move(line)); }
  static std::string name(const session_id& x) {
    return x.is_remote() ? std::string(1, "?AB"[x.provider.value()]) : "own";
  }

  void feed_local(const service_input&) override {}
  void feed_remote(service_input x) override {
    write("feed " + name(x.session) + (x.standby ? ", stand by" : ""));
  }
  void use(const service_result& x) override {
    write("use " + name(x.session));
  }
  void go_remote() override { write("own function rests"); }
  void go_local(service_input x) override {
    write(x.in_use.type().empty() ? "own function plans anew"
                                  : "own function plans on");
  }
  void run_along(service_input x) override {
    CHECK(x.standby);
    write("own function runs along");
  }
  void rest() override { write("own function rests again"); }
  void announce_source(bool remote) override {
    write(remote ? "source: remote" : "source: local");
  }
  void report_first_data(const session_id& x) override {
    write("first data of " + name(x));
  }
  void report(qos_violation x) override {
    write(
        (x.breach == qos_breach::implausible ? "implausible: " : "violation: ")
        + name(x.session));
  }
  void report_safe_response(duration longest) override { safe = longest; }
  void watch(const session_id& x, time_point) override {
    write("watch " + name(x));
  }
  void watch_arrival(const arrival&) override {}
  void watch_limits(const qos_limits& x) override {
    write("limits: " + std::to_string(x.max_latency / 1ms) + " ms, input "
          + std::to_string(x.max_input_age / 1ms) + " ms");
  }
  void watch_useless(const session_id& x, const implausibility&) override {
    write("useless: " + name(x));
  }
  void watch_end(const service_end&) override { write("watch nothing"); }
  void record(sofof::messages::record&& x) override {
    if (const auto* event = std::get_if<event_record>(&x)) {
      write(std::string{name_of(event->what)});
      detail = event->detail;
    }
    if (const auto* done = std::get_if<work_record>(&x))
      work.push_back(*done);
    if (const auto* seen = std::get_if<scene_record>(&x))
      scenes.push_back(*seen);
  }
  void wake_at(time_point t, std::uint64_t number) override {
    wakes.emplace_back(t, number);
  }

  std::vector<std::pair<time_point, std::uint64_t>> wakes;
};

using lines = std::vector<std::string>;

/// Numbers that are milliseconds under which the scene is safe; 0: unknown.
struct numbers_of_a_scene final : offloading::vehicle_service {
  std::shared_ptr<offloading::service_function> make_function() const override {
    return nullptr;
  }
  std::optional<offloading::safe_response>
  look_at_scene(const service_input& latest) const override {
    const auto number = latest.what.as<echo>()->number;
    if (number == 0)
      return std::nullopt;
    return offloading::safe_response{std::chrono::milliseconds{number},
                                     "follow"};
  }
};

struct selecting {
  const session_id own{0, 101, "numbers", 0};
  const session_id a{1, 101, "numbers", 7}, b{2, 101, "numbers", 8};
  diary port;
  source_selector selector{numbers_setup(), port};
  std::uint64_t cycle = 0;
  duration input_age = 100ms; ///< Of results.

  selecting() { selector.on_input({own, at(0s), of(1)}, at(0s)); }

  void session(const session_id& x, duration t) {
    selector.on_session(x, at(t));
  }
  void result(const session_id& x, duration t, duration latency = 10ms,
              std::uint64_t number = 1) {
    selector.on_result({.session = x,
                        .cycle = ++cycle,
                        .created = at(t) - latency,
                        .what = of(number),
                        .timing = {.input_at = at(t) - input_age}},
                       at(t));
  }
  void end(const session_id& x, duration t,
           end_reason why = end_reason::qos_gap) {
    selector.on_end({x, why, side::requester}, at(t));
  }
  /// @returns what has been written since the last call.
  lines news() { return std::exchange(port.lines, {}); }
};

} // namespace

TEST_CASE_FIXTURE(selecting, "without a provider the own function's results "
                             "are used") {
  result(own, 10ms);
  CHECK(news() == lines{"use own"});
}

TEST_CASE_FIXTURE(selecting, "a provider is fed at once, and used from its "
                             "first result in time on") {
  session(a, 100ms);
  CHECK(news() == lines{"feed A"});
  result(a, 200ms, 50ms + 1ns);
  CHECK(news() == lines{"result_refused"});
  CHECK_FALSE(selector.is_remote());
  result(a, 250ms, 50ms);
  CHECK(news()
        == lines{"own function rests", "watch A", "source: remote",
                 "first data of A", "use A"});
  CHECK(selector.is_remote());
  result(own, 260ms);
  CHECK(news().empty());
}

TEST_CASE_FIXTURE(selecting, "a result of an input that is too old is refused, "
                             "however fast it was made, and an event says so") {
  session(a, 100ms);
  news();
  input_age = 500ms + 1ns;
  result(a, 200ms, 1ms);
  CHECK(news() == lines{"result_refused"});
  CHECK(port.detail == "input_age value_ms=500.000001 limit_ms=500.000000");
  CHECK_FALSE(selector.is_remote());
  input_age = 500ms;
  result(a, 250ms, 1ms);
  CHECK(selector.is_remote());
}

TEST_CASE_FIXTURE(selecting, "the own function plans on at once when the last "
                             "provider ends, and anew after an implausible "
                             "result") {
  session(a, 100ms);
  result(a, 150ms);
  news();
  SUBCASE("silent") {
    end(a, 300ms);
    CHECK(news()
          == lines{"watch nothing", "own function plans on", "source: local"});
    end(a, 300ms);
    CHECK(news().empty());
  }
  SUBCASE("implausible") {
    result(a, 200ms, 10ms, implausible);
    CHECK(news()
          == lines{"watch nothing", "own function plans anew", "source: local",
                   "implausible: A"});
  }
  CHECK_FALSE(selector.is_remote());
}

TEST_CASE_FIXTURE(selecting, "results that come twice or out of order are not "
                             "used, nor those of unknown sessions") {
  session(a, 100ms);
  result(a, 150ms);
  news();
  selector.on_result({a, cycle, at(190ms), of(1)}, at(200ms));
  CHECK(port.detail == fmt::format("cycle {0} after {0}", cycle));
  CHECK(news() == lines{"result_refused"});
  // A provider that repeats itself fills no file with it.
  for (auto t = 210ms; t < 400ms; t += 10ms)
    selector.on_result({a, cycle - 1, at(190ms), of(1)}, at(t));
  CHECK(news().empty());
  selector.on_result({a, cycle - 1, at(190ms), of(1)}, at(400ms));
  CHECK(port.detail == fmt::format("cycle {} after {}", cycle - 1, cycle));
  CHECK(news() == lines{"result_refused"});
  result(b, 400ms);
  CHECK(news().empty());
}

TEST_CASE_FIXTURE(selecting,
                  "a useless result is not used, and the watchdog is "
                  "told why") {
  session(a, 100ms);
  result(a, 150ms);
  news();
  result(a, 200ms, 10ms, useless);
  CHECK(news() == lines{"result_refused", "useless: A"});
  CHECK(port.detail == "number value=1001.000 limit=999.000");
  CHECK(selector.is_remote());
}

TEST_CASE_FIXTURE(selecting, "a result by a clock that is not known is not "
                             "used") {
  session(a, 100ms);
  selector.on_result({a, 1, at(140ms), of(1), {}, 26ms}, at(150ms));
  CHECK(news() == lines{"feed A", "clock_in_doubt", "result_refused"});
  CHECK(port.detail == "clock_doubt value_ms=26.000000 limit_ms=25.000000");
  selector.on_result({a, 2, at(190ms), of(1), {}, 25ms}, at(200ms));
  CHECK(news().front() == "clock_known");
  CHECK(selector.is_remote());
}

TEST_CASE_FIXTURE(selecting, "of two providers the first result of each cycle "
                             "is used") {
  session(a, 100ms);
  result(a, 150ms);
  session(b, 160ms);
  news();
  selector.on_result({b, 1, at(190ms), of(1)}, at(200ms));
  CHECK(news() == lines{"first data of B", "use B"});
  selector.on_result({a, 10, at(192ms), of(1)}, at(210ms));
  CHECK(news().empty());
  SUBCASE("and when one ends the other goes on") {
    end(a, 220ms);
    CHECK(news() == lines{"watch B"});
    CHECK(selector.is_remote());
    end(b, 230ms);
    CHECK_FALSE(selector.is_remote());
  }
}

TEST_CASE_FIXTURE(selecting,
                  "a provider that has not been in time for a second "
                  "beside another one is reported once") {
  session(a, 0ms);
  result(a, 50ms);
  session(b, 50ms);
  result(b, 60ms);
  news();
  for (auto t = 100ms; t <= 1060ms; t += 50ms)
    result(a, t);
  for (const auto& line : news())
    CHECK(line == "use A");
  for (auto t = 1100ms; t <= 1300ms; t += 50ms)
    result(a, t);
  const auto told = news();
  CHECK(std::ranges::count(told, "violation: B") == 1);
}

TEST_CASE_FIXTURE(selecting, "a standby is fed only when a cycle is not "
                             "answered in time") {
  session(a, 0ms);
  result(a, 50ms, 10ms);
  session(b, 50ms);
  result(b, 60ms, 10ms);
  news();
  selector.on_standby(standby{2, 30ms}, at(70ms));
  CHECK(news() == lines{"feed B, stand by"});
  selector.on_input({own, at(110ms), of(2)}, at(110ms));
  CHECK(news() == lines{"feed A"});
  REQUIRE_FALSE(port.wakes.empty());
  const auto [due, number] = port.wakes.back();
  // The cycle of A that was answered last began at 50 ms.
  CHECK(due == at(50ms + 50ms + 30ms));
  SUBCASE("which it is told of by an input") {
    selector.on_timer(number, due);
    CHECK(news() == lines{"feed B, stand by"});
  }
  SUBCASE("and not when it is") {
    result(a, 120ms, 20ms);
    news();
    selector.on_timer(number, due);
    CHECK(news().empty());
  }
  SUBCASE("and fed as any other once it stands by no longer") {
    selector.on_standby(std::nullopt, at(210ms));
    CHECK(news() == lines{"feed B"});
  }
  SUBCASE("and is an ordinary source when the other one ends") {
    end(a, 210ms);
    CHECK(news() == lines{"feed B", "watch B"});
  }
}

TEST_CASE_FIXTURE(selecting, "what was done is recorded once a second, when "
                             "the source changes, and at last") {
  for (int k = 0; k < 5; ++k)
    result(own, k * 50ms);
  session(a, 300ms);
  selector.on_input({own, at(400ms), of(2)}, at(400ms));
  CHECK(port.work.empty());
  result(a, 450ms);
  REQUIRE(port.work.size() == 1);
  CHECK(port.work[0].station == 101);
  CHECK(port.work[0].service == service_name{"numbers"});
  CHECK(port.work[0].on_board == 5);
  CHECK(port.work[0].inputs == 2);
  CHECK(port.work[0].received == 1);
  CHECK(port.work[0].at == at(450ms));
  selector.on_input({own, at(1s), of(3)}, at(1s));
  end(a, 1100ms);
  REQUIRE(port.work.size() == 2);
  CHECK(port.work[1].on_board == 0);
  CHECK(port.work[1].inputs == 1);
  CHECK(port.work[1].since == at(1s)); // nothing happened until then
  CHECK(port.work[1].at == at(1100ms));
  result(own, 1200ms);
  selector.record_work();
  REQUIRE(port.work.size() == 3);
  CHECK(port.work[2].on_board == 1);
  selector.record_work();
  CHECK(port.work.size() == 3);
}

TEST_CASE_FIXTURE(selecting, "what the own function computes counts, whether "
                             "it is used or not") {
  const auto computed = [this](duration t) {
    selector.on_result({.session = own,
                        .cycle = ++cycle,
                        .created = at(t),
                        .what = of(1),
                        .timing = {.input_at = at(t), .computing = 5ms}},
                       at(t));
  };
  computed(50ms);
  session(a, 100ms);
  result(a, 200ms);
  computed(210ms); // on its way when the source changed
  selector.record_work();
  REQUIRE(port.work.size() == 2);
  CHECK(port.work[0].computed == 1);
  CHECK(port.work[0].computing == 5ms);
  CHECK(port.work[1].on_board == 0);
  CHECK(port.work[1].computed == 1);
  CHECK(port.work[1].computing == 5ms);
}

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

namespace {

/// A service whose scene says how late its results may be: 50 ms at most, 20 ms
/// at least; 100 ms are left for a gap.
struct limited_by_scene {
  const session_id own{0, 101, "numbers", 0}, a{1, 101, "numbers", 7};
  diary port;
  source_selector selector;
  std::uint64_t cycle = 0;

  static offloading::selector_setup setup() {
    auto made = numbers_setup();
    made.service.own = std::make_shared<numbers_of_a_scene>();
    made.service.options.latency_by_scene = true;
    made.service.options.latency_floor = 20ms;
    return made;
  }
  limited_by_scene() : selector{setup(), port} {}

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
