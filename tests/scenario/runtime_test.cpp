// The clocks of runtimes that talk to others: each has its own, which may be
// off.
#include "scenario/runtime.hpp"

#include "actors/runtime/time.hpp"

#include <caf/io/middleman.hpp>
#include <caf/scoped_actor.hpp>
#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>

namespace sofof::test::runtime_clocks {

using namespace actors;
using namespace scenario;
using namespace std::chrono_literals;

namespace {

/// Nothing here takes that long unless a clock's error enters twice or never.
constexpr duration off_by = 1min, patience = 20s;

std::unique_ptr<network_runtime> runtime_with(const clock_error& error) {
  caf::io::middleman::init_global_meta_objects();
  return make_network_runtime(error);
}

time_point machine_time() {
  return time_point{std::chrono::steady_clock::now().time_since_epoch()};
}

/// @returns how long a timer of `wait` takes by the machine's clock.
duration time_of_timer(network_runtime& time, duration wait) {
  caf::scoped_actor self{time.system()};
  const auto begun = machine_time();
  send_after(self.ptr(), caf::actor_cast<caf::actor>(self), wait, 7);
  bool rang = false;
  self->receive([&rang](int) { rang = true; }, caf::after(patience) >> [] {});
  CHECK(rang);
  return machine_time() - begun;
}

} // namespace

TEST_CASE("what a wrong clock means is what it was when it showed that") {
  const time_point from{100s};
  for (const auto& error :
       {clock_error{}, clock_error{500ms, 0, {}}, clock_error{-2s, 0, {}},
        clock_error{3s, 1e-3, from}, clock_error{-3s, -1e-3, from}})
    for (const auto t : {from, from + 1ms, from + 1h}) {
      const auto back = error.meant(error.shown(t));
      CHECK(std::abs((back - t).count()) <= 1000);
    }
  const clock_error fast{1s, 1e-3, from};
  CHECK(fast.shown(from) == from + 1s);
  CHECK(fast.shown(from + 10s) == from + 11s + 10ms);
}

TEST_CASE("runtimes of one process have clocks of their own") {
  const auto ahead = runtime_with({off_by, 0, {}}), right = runtime_with({});
  const auto by = ahead->now() - right->now();
  CHECK(std::abs((by - off_by).count()) < duration{patience}.count());
  caf::scoped_actor there{ahead->system()}, here{right->system()};
  const auto of_actors = now(there.ptr()) - now(here.ptr());
  CHECK(std::abs((of_actors - off_by).count()) < duration{patience}.count());
  const auto before = now(here.ptr());
  CHECK(clock_of(there.ptr())() >= before + off_by);
}

TEST_CASE("timers of a host last as long whatever its clock shows") {
  constexpr duration wait = 50ms;
  for (const auto shift : {duration{}, off_by, -off_by}) {
    const auto time = runtime_with({shift, 0, {}});
    const auto took = time_of_timer(*time, wait);
    CHECK(took >= wait);
    CHECK(took < patience);
  }
}

TEST_CASE("a runtime waits until its own clock shows the end") {
  for (const auto shift : {off_by, -off_by}) {
    const auto time = runtime_with({shift, 0, {}});
    const auto begun = machine_time();
    const auto end = time->now() + 20ms;
    time->run_until(end);
    CHECK(time->now() >= end);
    CHECK(machine_time() - begun < patience);
  }
}

} // namespace sofof::test::runtime_clocks
