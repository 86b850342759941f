// Tests of the ledger of computing time, on paper and with real actors.
#include "actors/runtime/accounting_scheduler.hpp"
#include "actors/runtime/cpu_accounts.hpp"
#include "tests/support/virtual_world.hpp"

#include <caf/actor_system_config.hpp>
#include <caf/event_based_actor.hpp>
#include <caf/scoped_actor.hpp>
#include <doctest/doctest.h>

#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::test;

namespace {

/// A ledger with a clock that obeys.
struct ledger_world {
  time_point now{1h};
  cpu_ledger ledger{[this] { return now; }};

  const cpu_account here{101, "planning", false};
  const cpu_account far{101, "planning", true};
};

struct accounting_config : caf::actor_system_config {
  accounting_config() {
    load<accounting_scheduler>();
    set("caf.scheduler.max-threads", 3u);
  }
};

/// Computes for a while, on its own thread's clock.
void compute(duration how_long) {
  const auto began = thread_cpu_time();
  while (thread_cpu_time() - began < how_long)
    ;
}

struct worker_state {
  static inline const char* name = "worker";
};
struct idler_state {
  static inline const char* name = "idler";
};

/// Computes for as many milliseconds as it is told, and says so.
template <class State>
caf::behavior computing(caf::stateful_actor<State>*) {
  return {[](int ms) {
    compute(std::chrono::milliseconds{ms});
    return ms;
  }};
}

/// Real threads, real time.
struct accounting_world {
  accounting_config config;
  caf::actor_system system{config};
  caf::scoped_actor self{system};

  void tell(const caf::actor& who, int ms) {
    self->request(who, caf::infinite, ms)
        .receive([](int) {}, [](const caf::error&) { FAIL("no answer"); });
  }

  /// A turn is entered a moment after its answer.
  /// @returns the lines, once all workers together have computed for so long.
  std::vector<cpu_line> lines_after(duration computed) {
    constexpr auto looks = 5000;
    for (auto k = 0; k < looks; ++k) {
      auto lines = ledger_of(system)->lines();
      duration cpu{};
      for (const auto& line : lines)
        if (line.actor == worker_state::name)
          cpu += line.cpu;
      if (cpu >= computed)
        return lines;
      std::this_thread::sleep_for(1ms);
    }
    FAIL("a turn was not entered");
    return {};
  }
};

cpu_line line_of(const std::vector<cpu_line>& lines, std::string_view actor,
                 const cpu_account& account) {
  for (const auto& line : lines)
    if (line.actor == actor && line.account == account)
      return line;
  return {};
}

} // namespace

TEST_CASE_FIXTURE(ledger_world, "turns of an actor add up on its account") {
  ledger.charge(7, here);
  ledger.add_turn(7, "planner", 3ms);
  ledger.add_turn(7, "planner", 4ms);
  now += 2s;
  const auto lines = ledger.lines();
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].account == here);
  CHECK(lines[0].actor == "planner");
  CHECK(lines[0].cpu == 7ms);
  CHECK(lines[0].time == 2s);
  CHECK(lines[0].wakes == 2);
}

TEST_CASE_FIXTURE(ledger_world,
                  "an actor that changes its account takes nothing along") {
  ledger.charge(7, here);
  ledger.add_turn(7, "planner", 3ms);
  now += 2s;
  ledger.charge(7, far);
  ledger.add_turn(7, "planner", 1ms);
  now += 5s;
  ledger.charge(7, here);
  ledger.add_turn(7, "planner", 10ms);
  now += 1s;
  const auto lines = ledger.lines();
  REQUIRE(lines.size() == 2);
  CHECK(line_of(lines, "planner", here).cpu == 13ms);
  CHECK(line_of(lines, "planner", here).time == 3s);
  CHECK(line_of(lines, "planner", far).cpu == 1ms);
  CHECK(line_of(lines, "planner", far).time == 5s);
}

TEST_CASE_FIXTURE(ledger_world, "an account that stays the same is not cut") {
  ledger.charge(7, here);
  ledger.add_turn(7, "planner", 3ms);
  now += 2s;
  ledger.charge(7, here);
  now += 2s;
  CHECK(ledger.lines().at(0).time == 4s);
}

TEST_CASE_FIXTURE(ledger_world,
                  "actors of one name share a line, on one account") {
  ledger.add_turn(1, "link", 1ms);
  ledger.add_turn(2, "link", 2ms);
  ledger.charge(3, here);
  ledger.add_turn(3, "link", 4ms);
  now += 1s;
  const auto lines = ledger.lines();
  REQUIRE(lines.size() == 2);
  CHECK(line_of(lines, "link", {}).cpu == 3ms);
  CHECK(line_of(lines, "link", {}).time == 2s);
  CHECK(line_of(lines, "link", here).cpu == 4ms);
}

TEST_CASE_FIXTURE(ledger_world, "no time passes for an actor that has ended") {
  ledger.add_turn(1, "link", 1ms);
  now += 1s;
  ledger.close(1);
  now += 10s;
  CHECK(ledger.lines().at(0).time == 1s);
  CHECK(ledger.lines().at(0).cpu == 1ms);
  ledger.close(2); // nobody knows it
}

TEST_CASE_FIXTURE(ledger_world, "a new beginning keeps accounts, but no sums") {
  ledger.charge(7, here);
  ledger.add_turn(7, "planner", 3ms);
  ledger.charge(8, here);
  ledger.add_turn(8, "another", 3ms);
  ledger.close(8);
  now += 2s;
  ledger.restart();
  now += 1s;
  ledger.add_turn(7, "planner", 1ms);
  const auto lines = ledger.lines();
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].account == here);
  CHECK(lines[0].cpu == 1ms);
  CHECK(lines[0].time == 1s);
}

TEST_CASE_FIXTURE(ledger_world, "who never had a turn is not listed") {
  ledger.charge(7, here);
  now += 2s;
  CHECK(ledger.lines().empty());
}

TEST_CASE_FIXTURE(accounting_world,
                  "what an actor computes is on its account, and no other's") {
  const auto busy = system.spawn(computing<worker_state>);
  const auto idle = system.spawn(computing<idler_state>);
  charge(system, busy.id(), {101, "planning", false});
  charge(system, idle.id(), {102, "planning", true});
  for (auto k = 0; k < 4; ++k) {
    tell(busy, 20);
    tell(idle, 0);
  }
  const auto lines = lines_after(80ms);
  const auto worked = line_of(lines, "worker", {101, "planning", false});
  const auto idled = line_of(lines, "idler", {102, "planning", true});
  CHECK(worked.cpu < 100ms);
  CHECK(worked.time >= worked.cpu);
  CHECK(idled.cpu > 0ms);
  CHECK(idled.cpu < 20ms);
}

TEST_CASE_FIXTURE(
    accounting_world,
    "several threads write into one ledger, and nothing is lost") {
  constexpr auto count = 8, turns = 50;
  std::vector<caf::actor> workers;
  for (auto k = 0; k < count; ++k) {
    workers.push_back(system.spawn(computing<worker_state>));
    charge(system, workers.back().id(), {101, {}, k % 2 == 0});
  }
  for (auto t = 0; t < turns; ++t) {
    for (const auto& w : workers)
      self->send(w, 1);
    for (auto k = 0; k < count; ++k)
      self->receive([](int) {});
    charge(system, workers.front().id(), {101, {}, t % 2 == 0});
  }
  duration cpu{};
  for (const auto& line : lines_after(1ms * count * turns))
    if (line.actor == "worker") {
      // A worker's first turn may come before it is charged to a station.
      const auto is_charged = line.account.station.has_value();
      if (is_charged)
        CHECK(line.account.station == 101);
      CHECK(line.wakes >= (is_charged ? turns : 1));
      cpu += line.cpu;
    }
  CHECK(cpu < 2ms * count * turns);
}

TEST_CASE("nobody keeps accounts unless asked to") {
  virtual_world virtual_time;
  CHECK(ledger_of(virtual_time.system()) == nullptr);
  charge(virtual_time.system(), 1, {101, {}, false});
  caf::actor_system_config config;
  caf::actor_system plain{config};
  CHECK(ledger_of(plain) == nullptr);
}
