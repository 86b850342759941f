// What was asked of servers, and when.
#include "channel/load_meter.hpp"

#include "channel/shared_server_queue.hpp"

#include <doctest/doctest.h>

#include <memory>

using namespace sofof;
using namespace sofof::channel;
using namespace std::chrono_literals;

namespace {

constexpr time_point start{100s};

load_figures::bin second(const load_figures& x, int k) {
  return x.between(k * 1s, (k + 1) * 1s);
}

} // namespace

TEST_CASE("a job counts in the second in which it arrives") {
  load_meter meter{1, start};
  meter.add(start + 999ms, 0ms, 1ms);
  meter.add(start + 2s, 0ms, 10ms);
  const auto all = meter.read();
  CHECK(second(all, 0).jobs == 1);
  CHECK(second(all, 0).asked == 1ms);
  CHECK(second(all, 1).jobs == 0);
  CHECK(second(all, 2).jobs == 1);
  CHECK(second(all, 2).asked == 10ms);
  CHECK(second(all, 3).jobs == 0);
  CHECK(all.between(0s, duration::max()).jobs == 2);
}

TEST_CASE("a bin counts in the time in which it begins") {
  load_meter meter{1, start};
  meter.add(start + 20ms, 0ms, 1ms);
  meter.add(start + 120ms, 0ms, 2ms);
  CHECK(meter.read().between(50ms, 150ms).asked == 2ms);
}

TEST_CASE("a job keeps servers busy when it is worked on, bin by bin") {
  load_meter meter{1, start};
  meter.add(start + 900ms, 250ms, 2s);
  const auto all = meter.read();
  CHECK(second(all, 0).busy == 0ms);
  CHECK(second(all, 1).busy == 850ms);
  CHECK(all.between(1100ms, 1200ms).busy == 50ms);
  CHECK(all.between(1200ms, 1300ms).busy == 100ms);
  CHECK(second(all, 2).busy == 1s);
  CHECK(second(all, 3).busy == 150ms);
  CHECK(second(all, 0).asked == 2s);
  CHECK(second(all, 0).waited == 250ms);
  CHECK(all.waits.ms().max() == 250);
}

TEST_CASE("servers' time is told by what it was used for") {
  load_meter meter{2, start};
  meter.add(start, 0ms, 250ms, "planning");
  meter.add(start + 50ms, 50ms, 30ms, "cabin");
  meter.add(start + 60ms, 0ms, 10ms);
  const auto all = meter.read();
  CHECK(all.busy_for("planning", 10s) == 250ms);
  CHECK(all.busy_for("planning", 200ms) == 200ms);
  CHECK(all.busy_for("cabin", 10s) == 30ms);
  CHECK(all.busy_for("cabin", 100ms) == 0ms);
  CHECK(all.busy_for("nothing", 10s) == 0ms);
  CHECK(all.between(0s, 10s).busy == 290ms);
}

TEST_CASE("a job from before the start counts from there") {
  load_meter meter{1, start};
  meter.add(start - 5s, 0ms, 10ms);
  CHECK(second(meter.read(), 0).asked == 10ms);
}

TEST_CASE("a queue that is asked for four times what it can do is busy all the "
          "time, and its meter says four times") {
  const auto meter = std::make_shared<load_meter>(1U, start);
  shared_server_queue queue{1, meter};
  for (int k = 0; k < 100; ++k)
    queue.finish(start + k * 100ms, 400ms);
  const auto all = meter->read();
  for (int k = 0; k < 10; ++k) {
    CHECK(second(all, k).asked == 4s);
    CHECK(second(all, k).busy == 1s);
  }
  CHECK(all.between(0s, duration::max()).busy == 100 * 400ms);
  CHECK(all.waits.ms().count() == 100);
  CHECK(all.waits.ms().max() == 99 * 300.0); // each waits 300 ms more
}

TEST_CASE("what two workers do together is theirs together") {
  const auto meter = std::make_shared<load_meter>(2U, start);
  shared_server_queue queue{2, meter};
  for (int k = 0; k < 4; ++k)
    queue.finish(start, 500ms);
  const auto all = meter->read();
  CHECK(all.servers == 2);
  CHECK(second(all, 0).busy == 2s);
  CHECK(second(all, 0).waited == 1s);
}
