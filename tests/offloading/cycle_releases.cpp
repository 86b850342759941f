// Tests of how close together cycles of a session may be run, whatever its
// inputs do: what response times are reckoned with.
#include "offloading/service_cycle.hpp"
#include "policies/api/periodic_task.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/echo.hpp"

#include <doctest/doctest.h>

#include <map>
#include <optional>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

constexpr auto period = 50ms;

/// A cycle, and when it was run.
struct released_cycle : offloading::cycle_port {
  struct copier final : offloading::service_function {
    offloading::service_output run(time_point,
                                   const service_input& input) override {
      return input.what;
    }
  };

  bool keeps_phase, per_input;
  std::optional<dice> interruptions; // of a core that it shares
  std::vector<time_point> releases;
  time_point done;
  std::multimap<time_point, std::uint64_t> timers;
  offloading::service_cycle cycle{
      {.session = {1, 101, "echo", 7},
       .function = std::make_shared<copier>(),
       .period = period,
       .phase = 20ms,
       .finish =
           [this](time_point start, std::uint64_t) {
             releases.push_back(start);
             done = start + 5ms;
             return offloading::cycle_work{done, 3ms};
           },
       .review = shared(),
       .keeps_phase = keeps_phase,
       .per_input = per_input},
      *this};

  released_cycle(bool keeps_phase, bool per_input,
                 std::optional<dice> interruptions = {})
      : keeps_phase{keeps_phase}, per_input{per_input}, interruptions{
                                                            interruptions} {}

  /// Cycles of a shared core take one period and a half at most.
  std::function<time_point(time_point)> shared() {
    if (!interruptions)
      return nullptr;
    return [this](time_point now) {
      if (done == now && interruptions->between(0, 2) < 1)
        done += from_seconds(interruptions->between(0, 0.03));
      return done;
    };
  }

  void wake_at(time_point t, std::uint64_t number) override {
    timers.emplace(t, number);
  }
  void deliver_at(time_point, service_result) override {}

  void run_until(time_point end) {
    while (!timers.empty() && timers.begin()->first <= end) {
      const auto due = timers.extract(timers.begin());
      cycle.on_timer(due.mapped(), due.key());
    }
  }

  /// Inputs come at random, often some at a time, of a vehicle that changes
  /// its mind whether the session stands by, if it may.
  void live(dice draw, bool stands_by) {
    time_point now{from_seconds(draw.between(1, 2))};
    cycle.on_step(lifecycle_step::configure, now);
    cycle.on_input({.at = now, .what = payload::of(echo{1})}, now);
    cycle.on_step(lifecycle_step::activate, now);
    for (int k = 0; k < 400; ++k) {
      now += draw.between(0, 2) < 1 ? from_seconds(draw.between(0, 0.002))
                                    : from_seconds(draw.between(0, 0.2));
      run_until(now);
      service_input input{.at = now, .what = payload::of(echo{1})};
      input.standby = stands_by && draw.between(0, 2) < 1;
      cycle.on_input(input, now);
    }
  }

  /// @returns whether no window has more than ⌊(length + J) / T⌋ + 1 of them.
  bool keep(duration jitter) const {
    for (std::size_t a = 0; a < releases.size(); ++a)
      for (auto b = a; b < releases.size(); ++b)
        if (static_cast<duration::rep>(b - a)
            > (releases[b] - releases[a] + jitter) / period)
          return false;
    return true;
  }
};

} // namespace

TEST_CASE("cycles that wait for their phase have no jitter, others that of one "
          "first cycle") {
  int early = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    released_cycle waits{true, false}, begins{false, false};
    waits.live(dice{seed}, false);
    begins.live(dice{seed}, false);
    CHECK(waits.releases.size() > 100);
    CHECK(waits.keep(0ns));
    early += !begins.keep(0ns);
    CHECK(begins.keep(policies::jitter_with_first_cycle(period)));
  }
  CHECK(early > 0);
}

TEST_CASE("cycles that are called by inputs have the jitter of calls, however "
          "inputs come") {
  int close = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const bool per_input : {true, false}) {
      released_cycle called{false, per_input};
      called.live(dice{seed}, !per_input);
      CHECK(called.releases.size() > 100);
      CHECK(called.keep(policies::jitter_of_calls(period)));
      close += !called.keep(policies::jitter_with_first_cycle(period));
    }
  CHECK(close > 0);
}

TEST_CASE("on a core that is shared cycles have the same jitter, however long "
          "each is under way") {
  int early = 0, close = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    released_cycle begins{false, false, dice{seed + 100}};
    begins.live(dice{seed}, false);
    CHECK(begins.releases.size() > 100);
    CHECK(begins.keep(policies::jitter_with_first_cycle(period)));
    early += !begins.keep(0ns);
    released_cycle called{false, true, dice{seed + 100}};
    called.live(dice{seed}, false);
    CHECK(called.keep(policies::jitter_of_calls(period)));
    close += !called.keep(policies::jitter_with_first_cycle(period));
  }
  CHECK(early > 0);
  CHECK(close > 0);
}
