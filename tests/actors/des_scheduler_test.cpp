// Tests of virtual time.
#include "actors/simulation/des_scheduler.hpp"

#include "tests/support/virtual_world.hpp"

#include <caf/event_based_actor.hpp>
#include <doctest/doctest.h>

#include <memory>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::test;

namespace {

caf::actor_clock::time_point moment(duration since_start) {
  return caf::actor_clock::time_point{since_start};
}

/// A clock alone, and what its entries did.
struct clock_world {
  des_clock clock;
  std::vector<int> order;

  caf::action note(int n) {
    return caf::make_action([this, n] { order.push_back(n); });
  }
  void fire_all() {
    while (!clock.empty())
      clock.fire_next();
  }
};

/// A scheduler with actors, and what they were told.
struct scheduled_world : virtual_world {
  std::vector<std::pair<time_point, int>> heard;

  des_scheduler& time() {
    return dynamic_cast<des_scheduler&>(system().scheduler());
  }

  /// An actor that notes numbers.
  caf::actor listener() {
    return own(
        system().spawn([this](caf::event_based_actor* self) -> caf::behavior {
          return {[this, self](int n) {
            heard.emplace_back(sofof::actors::now(self), n);
          }};
        }));
  }

  /// An actor that sends itself a number, again and again.
  caf::actor metronome(duration period) {
    return own(system().spawn(
        [this, period](caf::event_based_actor* self) -> caf::behavior {
          send_after(self, self, period, 1);
          return {[this, self, period](int n) {
            heard.emplace_back(sofof::actors::now(self), n);
            send_after(self, self, period, n + 1);
          }};
        }));
  }
};

} // namespace

TEST_CASE_FIXTURE(clock_world, "entries fire in the order of their times") {
  clock.schedule(moment(3s), note(3));
  clock.schedule(moment(1s), note(1));
  clock.schedule(moment(2s), note(2));
  fire_all();
  CHECK(order == std::vector{1, 2, 3});
  CHECK(clock.now() == moment(3s));
}

TEST_CASE_FIXTURE(clock_world,
                  "entries of one moment fire in the order they were made") {
  std::vector<int> made;
  for (int n = 0; n < 100; ++n) {
    clock.schedule(moment(1s), note(n));
    made.push_back(n);
  }
  fire_all();
  CHECK(order == made);
}

TEST_CASE_FIXTURE(clock_world,
                  "a cancelled entry neither runs nor moves the time") {
  clock.schedule(moment(1s), note(1));
  auto cancelled = clock.schedule(moment(10s), note(2));
  cancelled.dispose();
  fire_all();
  CHECK(order == std::vector{1});
  CHECK(clock.now() == moment(1s));
}

TEST_CASE_FIXTURE(clock_world, "an entry for the past fires now") {
  clock.advance_to(moment(5s));
  clock.schedule(moment(1s), note(1));
  fire_all();
  CHECK(order == std::vector{1});
  CHECK(clock.now() == moment(5s));
}

TEST_CASE_FIXTURE(clock_world, "time never goes back") {
  clock.advance_to(moment(5s));
  clock.advance_to(moment(2s));
  CHECK(clock.now() == moment(5s));
}

TEST_CASE_FIXTURE(clock_world,
                  "a periodic entry fires period by period until cancelled") {
  std::vector<caf::actor_clock::time_point> fired;
  auto periodic = clock.schedule_periodically(
      moment(1s), caf::make_action([&] { fired.push_back(clock.now()); }), 2s);
  for (int k = 0; k < 4; ++k) {
    REQUIRE(!clock.empty());
    clock.fire_next();
  }
  CHECK(fired == std::vector{moment(1s), moment(3s), moment(5s), moment(7s)});
  periodic.dispose();
  fire_all();
  CHECK(fired.size() == 4);
  CHECK(clock.now() == moment(7s));
}

TEST_CASE_FIXTURE(scheduled_world,
                  "run_until ends exactly there, entries at the end included") {
  auto all = listener();
  time().clock().schedule(moment(1s),
                          caf::make_action([&] { caf::anon_send(all, 1); }));
  time().clock().schedule(moment(1s + 1ns),
                          caf::make_action([&] { caf::anon_send(all, 2); }));
  time().run_until(time_point{1s});
  REQUIRE(heard.size() == 1);
  CHECK(heard.front() == std::pair{time_point{1s}, 1});
  CHECK(now() == time_point{1s});
  time().run_until(time_point{1500ms});
  CHECK(heard.size() == 2);
  CHECK(now() == time_point{1500ms});
}

TEST_CASE_FIXTURE(scheduled_world,
                  "a cancelled entry far away does not carry run_until along") {
  time().clock().schedule(moment(10s), caf::make_action([] {})).dispose();
  time().run_until(time_point{1s});
  CHECK(now() == time_point{1s});
}

TEST_CASE_FIXTURE(scheduled_world,
                  "a cancelled entry does not hide those behind it") {
  auto all = listener();
  time().clock().schedule(moment(1s), caf::make_action([] {})).dispose();
  time().clock().schedule(moment(2s),
                          caf::make_action([&] { caf::anon_send(all, 2); }));
  time().run_until(time_point{3s});
  REQUIRE(heard.size() == 1);
  CHECK(heard.front().first == time_point{2s});
}

TEST_CASE_FIXTURE(scheduled_world,
                  "an actor that wakes itself up keeps its period exactly") {
  metronome(100ms);
  run_for(1s);
  REQUIRE(heard.size() == 10);
  for (int k = 1; k <= 10; ++k)
    CHECK(heard[static_cast<std::size_t>(k - 1)]
          == std::pair{time_point{100ms * k}, k});
}

TEST_CASE_FIXTURE(scheduled_world,
                  "all messages of a moment are handled before time moves on") {
  auto all = listener();
  auto relay =
      own(system().spawn([all](caf::event_based_actor* self) -> caf::behavior {
        return {[self, all](int n) {
          self->send(all, n);
          if (n > 0)
            self->send(self, n - 1);
        }};
      }));
  time().clock().schedule(moment(1s),
                          caf::make_action([&] { caf::anon_send(relay, 50); }));
  time().clock().schedule(moment(1s + 1ns),
                          caf::make_action([&] { caf::anon_send(all, -1); }));
  run_for(2s);
  REQUIRE(heard.size() == 52);
  CHECK(heard[50] == std::pair{time_point{1s}, 0});
  CHECK(heard[51] == std::pair{time_point{1s + 1ns}, -1});
}

TEST_CASE_FIXTURE(scheduled_world, "ready actors take turns") {
  auto all = listener();
  const auto speaker = [&](int first) {
    return own(system().spawn(
        [all, first](caf::event_based_actor* self) -> caf::behavior {
          return {[self, all, first](int n) { self->send(all, first + n); }};
        }));
  };
  const auto a = speaker(0), b = speaker(10);
  for (int n = 0; n < 3; ++n)
    caf::anon_send(a, n);
  for (int n = 0; n < 3; ++n)
    caf::anon_send(b, n);
  settle();
  std::vector<int> order;
  for (const auto& [at, n] : heard)
    order.push_back(n);
  CHECK(order == std::vector{0, 10, 1, 11, 2, 12});
}

TEST_CASE("a world with periodic actors can end, and they end with it") {
  auto w = std::make_unique<scheduled_world>();
  const auto alive = std::make_shared<int>();
  w->own(
      w->system().spawn([alive](caf::event_based_actor* self) -> caf::behavior {
        send_after(self, self, 1ms, 1);
        return {[self, alive](int n) { send_after(self, self, 1ms, n); }};
      }));
  w->run_for(10ms);
  CHECK(alive.use_count() > 1);
  w.reset();
  CHECK(alive.use_count() == 1);
}
