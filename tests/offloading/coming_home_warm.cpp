// A selector whose own function runs along: message by message, without actors.
#include "offloading/source_selector.hpp"
#include "tests/support/at.hpp"
#include "tests/support/echo.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace std::chrono_literals;

using test::at;
using test::echo;

namespace {

constexpr std::uint64_t a_lie = 1000, a_jump = 1001;

struct jumpy_numbers final : offloading::vehicle_service {
  struct believer final : offloading::result_judge {
    offloading::judged_result judge(const payload& result, const service_input&,
                                    time_point) override {
      if (result.as<echo>()->number == a_lie)
        return {.what = {}, .refused = objection{"number", 1000, 999}};
      return {.what = result};
    }
  };
  std::shared_ptr<offloading::service_function> make_function() const override {
    return nullptr; // a selector needs none
  }
  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return std::make_unique<believer>();
  }
  bool continues(const payload&, const payload& offered,
                 time_point) const override {
    return offered.as<echo>()->number != a_jump;
  }
};

/// A provider runs the service; the own function ran along for the first two
/// seconds. Writes down what becomes of the own function and of the source.
struct warm_world : offloading::selector_port {
  const session_id own{0, 101, "numbers", 0}, there{1, 101, "numbers", 7};
  std::vector<std::string> lines;
  std::vector<std::pair<time_point, std::uint64_t>> timers;
  work_record work;
  service_input called; // the latest
  time_point now;
  std::uint64_t cycle = 0;
  offloading::source_selector selector;

  static offloading::selector_setup setup(duration warm, bool per_input) {
    offloading::service_options options;
    options.limits = {50ms, 100ms, 500ms};
    options.period = 50ms;
    options.input_period = 100ms;
    options.warm_standby = warm;
    options.per_input = per_input;
    return {101, {"numbers", options, std::make_shared<jumpy_numbers>()}};
  }

  explicit warm_world(duration warm = 2s, bool per_input = false)
      : selector{setup(warm, per_input), *this} {
    input();
    selector.on_session(there, now);
    remote();
  }

  void feed_local(const service_input&) override { write("observes"); }
  void feed_remote(service_input) override {}
  void use(const service_result& x) override {
    write(x.session.is_remote() ? "use" : "use own");
  }
  void go_remote() override { write("remote"); }
  void run_along(service_input x) override {
    write("run");
    called = std::move(x);
  }
  void rest() override { write("rest"); }
  void go_local(service_input x) override {
    write(x.in_use.empty() ? "plan anew" : "plan on");
    called = std::move(x);
  }
  void announce_source(bool is_remote) override {
    if (!is_remote)
      write("home");
  }
  void report_first_data(const session_id&) override {}
  void report(qos_violation) override {}
  void report_safe_response(duration) override {}
  void watch(const session_id&, time_point) override {}
  void watch_arrival(const arrival&) override {}
  void watch_limits(const qos_limits&) override {}
  void watch_useless(const session_id&, const implausibility&) override {}
  void watch_end(const service_end&) override {}
  void record(sofof::messages::record&& x) override {
    if (const auto* done = std::get_if<work_record>(&x))
      work = *done;
  }
  void wake_at(time_point t, std::uint64_t number) override {
    timers.emplace_back(t, number);
  }

  void write(std::string line) { lines.push_back(std::move(line)); }
  /// @returns what has been written since the last call.
  std::vector<std::string> news() { return std::exchange(lines, {}); }

  /// Goes on to that time; timers that are due by then run.
  void until(duration t) {
    for (;;) {
      const auto due = std::ranges::min_element(timers);
      if (due == timers.end() || due->first > at(t))
        break;
      const auto [then, number] = *due;
      timers.erase(due);
      now = std::max(now, then);
      selector.on_timer(number, now);
    }
    now = at(t);
  }
  void input() { selector.on_input({own, now, payload::of(echo{1})}, now); }
  void result(const session_id& of, duration age, std::uint64_t number) {
    selector.on_result({.session = of,
                        .cycle = ++cycle,
                        .created = now - age,
                        .what = payload::of(echo{number}),
                        .timing = {.input_at = now - age}},
                       now);
  }
  void remote(std::uint64_t number = 2) { result(there, 10ms, number); }
  void own_result(duration age = 5ms, std::uint64_t number = 3) {
    result(own, age, number);
  }
  void end(end_reason why = end_reason::qos_gap) {
    selector.on_end({there, why, side::requester}, now);
  }
  /// Results come every 50 ms, inputs every 100 ms.
  void drive_until(duration t) {
    for (auto k = ((now - at(0s)) / 50ms + 1) * 50ms; k <= t; k += 50ms) {
      until(k);
      if (k % 100ms == 0ms)
        input();
      remote();
    }
  }
};

using words = std::vector<std::string>;

struct cold_world : warm_world {
  cold_world() : warm_world{0s} {}
};

struct warm_per_input : warm_world {
  warm_per_input() : warm_world{2s, true} {}
};

} // namespace

TEST_CASE_FIXTURE(warm_world, "the own function is called for each input for "
                              "its time after a provider has taken over, then "
                              "it rests and observes") {
  CHECK(news() == words{"observes", "remote", "use"});
  until(20ms);
  input();
  CHECK(news() == words{"run"});
  CHECK(called.standby);
  CHECK(called.in_use.as<echo>()->number == 2);
  drive_until(1950ms);
  news();
  until(2s);
  input();
  CHECK(news() == words{"rest", "observes"});
  remote();
  until(2050ms);
  input();
  CHECK(news() == words{"use", "observes"});
}

TEST_CASE_FIXTURE(cold_world, "without warm standby it observes from the "
                              "first moment on, and no timer is set") {
  news();
  drive_until(1s);
  const auto told = news();
  CHECK(std::ranges::count(told, "run") == 0);
  CHECK(std::ranges::count(told, "observes") == 10);
  CHECK(timers.empty());
  until(1100ms);
  end();
  CHECK(news() == words{"plan on", "home"});
}

TEST_CASE_FIXTURE(warm_world, "what it has ready is used at the very moment at "
                              "which the service comes home, and it goes on "
                              "from there") {
  until(20ms);
  input();
  until(26ms);
  own_result();
  CHECK(selector.is_remote());
  news();
  until(70ms);
  SUBCASE("after a fault") {
    end();
  }
  SUBCASE("on purpose") {
    end(end_reason::released);
  }
  CHECK(news() == words{"home", "use own", "plan on"});
  CHECK(called.in_use.as<echo>()->number == 3);
  CHECK_FALSE(called.standby);
}

TEST_CASE_FIXTURE(warm_world,
                  "nothing of it is used at once that is older than "
                  "two periods, or does not continue what is in "
                  "use, or may go on from a lie") {
  until(20ms);
  input();
  SUBCASE("old") {
    own_result();
    until(121ms);
    news();
    end();
    CHECK(news() == words{"plan on", "home"});
  }
  SUBCASE("it jumps") {
    own_result(5ms, a_jump);
    news();
    end();
    CHECK(news() == words{"plan on", "home"});
  }
  SUBCASE("after a lie") {
    own_result();
    until(30ms);
    news();
    remote(a_lie);
    CHECK(news() == words{"plan anew", "home"});
    own_result(5ms); // begun before
    CHECK(news().empty());
    until(40ms);
    own_result(5ms);
    CHECK(news() == words{"use own"});
  }
}

TEST_CASE_FIXTURE(warm_world, "a missing result has it begin before the limit "
                              "is reached, from the result in use") {
  drive_until(5s);
  news();
  until(5'075ms);
  CHECK(news().empty());
  until(5'076ms);
  CHECK(news() == words{"run"});
  CHECK(called.in_use.as<echo>()->number == 2);
  until(5'081ms);
  own_result();
  until(5'100ms);
  end();
  CHECK(news() == words{"home", "use own", "plan on"});
}

TEST_CASE_FIXTURE(warm_world, "a missing result calls it anew, though it runs "
                              "along already") {
  drive_until(1s);
  news();
  until(1'076ms);
  CHECK(news() == words{"run"});
}

TEST_CASE_FIXTURE(warm_per_input, "one that has a result for each input is not "
                                  "called twice for the same") {
  drive_until(1s);
  news();
  until(1'076ms);
  CHECK(news().empty());
}

TEST_CASE_FIXTURE(warm_world, "who foresees a change home has it run along at "
                              "once") {
  drive_until(5s);
  news();
  selector.on_home_is_near(now);
  CHECK(news() == words{"run"});
  selector.on_home_is_near(now);
  CHECK(news().empty());
  drive_until(6'950ms);
  news();
  until(7s);
  input();
  CHECK(news() == words{"rest", "observes"});
  end();
  news();
  selector.on_home_is_near(now);
  CHECK(news().empty());
}

TEST_CASE_FIXTURE(warm_world, "results of it that are not used are counted as "
                              "work") {
  until(20ms);
  input();
  for (int k = 0; k < 3; ++k)
    own_result();
  selector.record_work();
  CHECK(work.along == 2); // the third one may still be of use
  CHECK(work.on_board == 0);
  end();
  own_result();
  selector.record_work();
  CHECK(work.along == 0);
  CHECK(work.on_board == 2);
}

TEST_CASE_FIXTURE(warm_world,
                  "an input of what has just come home has it begin "
                  "at once, though it runs along only") {
  until(20ms);
  service_input fresh{own, now, payload::of(echo{1})};
  fresh.at_once = true;
  selector.on_input(fresh, now);
  CHECK(called.at_once);
  CHECK(called.standby);
  until(70ms);
  input();
  CHECK_FALSE(called.at_once);
}

TEST_CASE_FIXTURE(warm_world, "a result of it that a later cycle has overtaken "
                              "is not used") {
  until(20ms);
  input();
  SUBCASE("while a provider runs the service") {
    own_result(5ms, 4);
    cycle -= 2; // of the one that comes now
    own_result(15ms, a_jump);
    news();
    end(); // with the later one, which continues
    CHECK(news() == words{"home", "use own", "plan on"});
  }
  SUBCASE("at home") {
    end();
    own_result(5ms, 4);
    cycle -= 2;
    news();
    own_result(15ms, 3);
    CHECK(news().empty());
    selector.record_work();
    CHECK(work.along == 1);
  }
}
