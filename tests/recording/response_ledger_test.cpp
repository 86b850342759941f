// From a look to the first control value that depends on it.
#include "recording/response_ledger.hpp"

#include "recording/results.hpp"
#include "tests/recording/folder_checks.hpp"
#include "tests/support/made_up_run.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

namespace sofof::made_up {

using namespace messages;
using namespace recording;
using test::scratch;

namespace {

const std::vector<std::string> chain{"tracking", "environment_model",
                                     "trajectory_planning"};

/// A vehicle whose chain is told step by step, in ms.
struct told_chain {
  response_ledger ledger{chain};
  std::vector<response_record> known{};
  std::vector<sensor_look> looks{}; // since the last plan

  void look(int sensed, int input) { looks.push_back({ms(sensed), ms(input)}); }
  /// A result of an input of that moment that came now, of which `down` took
  /// the way and `computing` the computing.
  void result(std::size_t service, provider_id by, int input, int now,
              int down = 0, int computing = 0) {
    stage_record x{101, service_name{chain[service]}, by, ms(now), {}};
    x.timing.input_at = ms(input);
    x.timing.down.travel = down * 1ms;
    x.timing.computing = computing * 1ms;
    if (service == 2) {
      x.control_at = ms(now + 4);
      x.looks = std::exchange(looks, {});
    }
    ledger.add(x, known);
  }
  std::vector<response_record> all() {
    ledger.finish(known);
    return known;
  }

  static time_point ms(int t) { return at(t * 1ms); }
};

duration sum_of(const response_record& x) {
  auto sum = x.waited + x.control;
  for (const auto& part : x.parts)
    sum += part.took.value_or(duration{0});
  return sum;
}

} // namespace

TEST_CASE("a response goes from the look through each service to the control "
          "value") {
  told_chain x;
  x.look(100, 101);
  x.result(0, 0, 101, 103);
  x.result(1, provider, 103, 130, 10, 3);
  x.result(2, 0, 130, 145);
  const auto all = x.all();
  REQUIRE(all.size() == 1);
  const auto& parts = all[0].parts;
  REQUIRE(parts.size() == 3);
  CHECK(parts[0].took == 3ms);
  CHECK(parts[1].took == 27ms);
  CHECK(parts[1].provider == provider);
  CHECK(parts[1].down == 10ms);
  CHECK(parts[2].took == 15ms);
  CHECK(all[0].control == 4ms);
  CHECK(all[0].response() == 49ms);
  CHECK(sum_of(all[0]) == 49ms);
}

TEST_CASE(
    "where services run one after the other at a provider, a plan depends "
    "on the newest look there, though its tracks come down later") {
  told_chain x;
  x.look(0, 0);
  x.result(0, provider, 0, 30, 10, 2);
  x.result(1, provider, 30, 60, 10, 2);
  x.look(100, 100);
  // Its cycle at the provider begins at 118, ...
  x.result(2, provider, 60, 145, 10, 15); // ... a plan's at 120.
  x.result(0, provider, 100, 150, 30, 2);
  x.result(1, provider, 150, 180, 10, 2);
  const auto all = x.all();
  REQUIRE(all.size() == 2);
  CHECK(all[1].sensed_at == told_chain::ms(100));
  CHECK(all[1].waited == 0ms);
  CHECK_FALSE(all[1].parts[0].took);
  CHECK_FALSE(all[1].parts[1].took);
  CHECK(all[1].parts[2].took == 45ms);
  CHECK(sum_of(all[1]) == all[1].response());
  // Nothing that depends on the first look led to a plan before.
  CHECK(all[0].waited == 100ms);
  CHECK(sum_of(all[0]) == 149ms);
}

TEST_CASE("a look that was lost waits for the next one that leads to a plan") {
  told_chain x;
  x.look(0, 0);
  x.look(100, 100);
  x.result(0, 0, 100, 102);
  x.result(1, 0, 102, 104);
  x.result(2, 0, 104, 110);
  x.result(2, 0, 104, 160); // another plan by the same look
  const auto all = x.all();
  REQUIRE(all.size() == 2);
  CHECK(all[0].response() == 114ms);
  CHECK(all[0].waited == 100ms);
  CHECK(all[1].response() == 14ms);
}

TEST_CASE("responses are lines of responses.csv and figures of their split, "
          "and neither is there without planning") {
  const scratch dir;
  auto info = run();
  info.chain = chain;
  {
    results r{dir.path(), info};
    const auto stage = [&](std::size_t k, provider_id by, duration input,
                           duration got) {
      stage_record s{101, service_name{chain[k]}, by, at(got), {}};
      s.timing.input_at = at(input);
      if (k == 2) {
        s.control_at = at(got + 5ms);
        s.looks = {{at(5s), at(5s)}};
      }
      r.on_record(s);
    };
    stage(0, 0, 5s, 5s + 2ms);
    stage(1, provider, 5s + 2ms, 5s + 32ms);
    stage(2, 0, 5s + 32ms, 5s + 45ms);
    r.finish(at(100s), 2, false);
  }
  CHECK(content_of(dir / "responses.csv")
        == "t_s,station,split,response_ms,waited_ms,services_ms,control_ms\n"
           "5.000000000,101,vehicle>mec>vehicle,50.000000,0.000000,"
           "2.000000 30.000000 13.000000,5.000000\n");
  const auto summary = content_of(dir / "summary.json");
  CHECK(summary.find("vehicle>mec>vehicle") != summary.npos);
  CHECK(summary.find("\"p99_ms\": 50") != summary.npos);
  results later{dir.path(), run()};
  later.finish(at(100s), 2, false);
  CHECK_FALSE(std::filesystem::exists(dir / "responses.csv"));
}

TEST_CASE("who wants no lines of results gets none of responses, but figures") {
  const scratch dir;
  auto info = run();
  info.chain = {planning};
  info.cycles = false;
  results r{dir.path(), info};
  stage_record plan{101, planning, 0, at(5s + 20ms), {}};
  plan.looks = {{at(5s), at(5s)}};
  plan.timing.input_at = at(5s);
  plan.control_at = at(5s + 30ms);
  r.on_record(plan);
  r.finish(at(100s), 2, false);
  CHECK_FALSE(std::filesystem::exists(dir / "responses.csv"));
  CHECK(content_of(dir / "summary.json").find("\"p99_ms\": 30")
        != std::string::npos);
}

TEST_CASE("planning that does all by itself is measured as a chain of one") {
  response_ledger ledger{{planning}};
  std::vector<response_record> all;
  stage_record plan{101, planning, provider, at(4s + 83ms), {}};
  plan.looks = {{at(4s), at(4s)}, {at(4s + 50ms), at(4s + 50ms)}};
  plan.timing.input_at = at(4s + 50ms);
  plan.timing.up.travel = 5ms;
  plan.timing.down.travel = 3ms;
  plan.control_at = at(4s + 90ms);
  ledger.add(plan, all);
  ledger.finish(all);
  REQUIRE(all.size() == 2);
  CHECK(all[0].response() == 90ms);
  CHECK(all[0].waited == 50ms);
  CHECK(all[1].response() == 40ms);
  REQUIRE(all[1].parts.size() == 1);
  CHECK(all[1].parts[0].provider == provider);
  CHECK(all[1].parts[0].took == 33ms);
  CHECK(all[1].parts[0].up == 5ms);
  CHECK(all[1].control == 7ms);
}

} // namespace sofof::made_up
