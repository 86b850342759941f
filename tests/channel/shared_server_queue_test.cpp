// A queue before a few equal servers.
#include "channel/shared_server_queue.hpp"

#include "base/random.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <latch>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using test::near;
using namespace std::chrono_literals;

namespace {

constexpr time_point job_at(duration t) {
  return time_point{t};
}

} // namespace

TEST_CASE("a job that finds the worker idle is done after its own time") {
  shared_server_queue workers{1};
  CHECK(workers.finish(job_at(10ms), 3ms) == job_at(13ms));
  CHECK(workers.finish(job_at(20ms), 3ms) == job_at(23ms));
}

TEST_CASE("a job that finds the worker busy waits for it") {
  shared_server_queue workers{1};
  workers.finish(job_at(0ms), 10ms);
  CHECK(workers.finish(job_at(4ms), 1ms) == job_at(11ms));
  CHECK(workers.finish(job_at(5ms), 1ms) == job_at(12ms));
}

TEST_CASE("the worker that is free first takes the job") {
  shared_server_queue workers{2};
  CHECK(workers.finish(job_at(0ms), 10ms) == job_at(10ms));
  CHECK(workers.finish(job_at(0ms), 4ms) == job_at(4ms));
  CHECK(workers.finish(job_at(1ms), 2ms) == job_at(6ms));
  CHECK(workers.finish(job_at(1ms), 9ms) == job_at(15ms));
  CHECK(workers.finish(job_at(1ms), 0ms) == job_at(10ms));
}

TEST_CASE("a job from the past arrives with the last one") {
  shared_server_queue workers{2};
  workers.finish(job_at(10ms), 0ms);
  CHECK(workers.finish(job_at(2ms), 3ms) == job_at(13ms));
}

TEST_CASE("a queue without workers is refused") {
  CHECK_THROWS_AS(shared_server_queue{0}, std::invalid_argument);
}

// The count misses a missing lock where threads happen to take turns; a thread
// sanitizer does not.
TEST_CASE("no work is lost between threads that share a worker") {
  constexpr auto threads = 4;
  constexpr auto jobs = 300'000;
  shared_server_queue worker{1};
  worker.finish(job_at(0ms), 0ms);
  std::latch start{threads};
  {
    std::vector<std::jthread> pool;
    for (auto i = 0; i < threads; ++i)
      pool.emplace_back([&] {
        start.arrive_and_wait();
        for (auto j = 0; j < jobs; ++j)
          worker.finish(job_at(0ms), 1us);
      });
  }
  CHECK(worker.finish(job_at(0ms), 0ms) == job_at(threads * jobs * 1us));
}

TEST_CASE("random arrivals at one worker wait as queueing theory says") {
  // M/M/1 at load 1/2: the mean wait is the mean work.
  const random_stream s{1, "queue"};
  shared_server_queue worker{1};
  time_point now{};
  double waited_s = 0;
  constexpr auto jobs = 200'000;
  for (std::uint64_t n = 0; n < jobs; ++n) {
    now += from_seconds(s.exponential(2e-3, n, 0));
    const auto work = from_seconds(s.exponential(1e-3, n, 1));
    waited_s += to_seconds(worker.finish(now, work) - now - work);
  }
  CHECK(waited_s / jobs == near(1e-3, 0.05));
}
