// Whose results of a service a vehicle uses, message by message, without
// actors.
#include "offloading/source_selector.hpp"

#include "base/protocol.hpp"
#include "tests/offloading/selector_diary.hpp"
#include "tests/support/at.hpp"

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

using namespace test::numbers_service;
using test::at;

namespace {

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
