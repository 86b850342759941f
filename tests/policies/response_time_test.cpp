// Tests of response times, by examples that a pencil can follow; many mixes
// are played by tests/properties/response_times.cpp.
#include "policies/algorithms/scheduling/response_time.hpp"

#include <doctest/doctest.h>

#include <initializer_list>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;

namespace {

using responses = std::vector<duration>;

auto worst(std::initializer_list<session_group> mix, queue_order order,
           std::size_t workers = 1) {
  return worst_case_responses(std::vector(mix), order, workers);
}

constexpr session_group short_cycle{
    {.wcet = 2ms, .period = 5ms, .deadline = 5ms}};
constexpr session_group long_cycle{
    {.wcet = 4ms, .period = 20ms, .deadline = 20ms}};

constexpr periodic_task eight_ms{
    .wcet = 8ms, .period = 100ms, .deadline = 50ms};

} // namespace

TEST_CASE("first come, first served, a job waits for one job of everybody") {
  CHECK(worst({short_cycle, long_cycle}, queue_order::fifo)
        == responses{6ms, 6ms});
  CHECK(worst({{eight_ms, 5}}, queue_order::fifo) == responses{40ms});
}

TEST_CASE("a job that jitters may come together with the one before it") {
  // Two of the first session are there 2 ms after the begin: 3 + 3 + 2 − 2.
  const session_group late{{.wcet = 3ms, .period = 10ms, .jitter = 8ms}};
  const session_group other{{.wcet = 2ms, .period = 10ms}};
  CHECK(worst({late, other}, queue_order::fifo) == responses{6ms, 6ms});
  CHECK(worst({{{.wcet = 8ms,
                 .period = 100ms,
                 .jitter = jitter_with_first_cycle(100ms)},
                1}},
              queue_order::fifo)
        == responses{16ms - 1ns});
  CHECK(
      worst({{{.wcet = 8ms, .period = 100ms, .jitter = jitter_of_calls(100ms)},
              1}},
            queue_order::fifo)
      == responses{24ms - 1ns});
}

TEST_CASE("by deadlines, an urgent job waits for one that has just begun") {
  // The short one: 4 ms but for an instant, and itself.
  CHECK(worst({short_cycle, long_cycle}, queue_order::edf)
        == responses{6ms - 1ns, 6ms});
}

TEST_CASE("by deadlines, the longest response need not be that of jobs that "
          "come together") {
  // Together with the others the urgent one goes first, or waits for one of
  // them. When it comes 3 ms later its deadline is theirs: 6 − 3 + 1.
  const session_group urgent{{.wcet = 1ms, .period = 20ms, .deadline = 3ms}};
  const session_group others{{.wcet = 2ms, .period = 20ms, .deadline = 6ms}, 3};
  CHECK(worst({urgent, others}, queue_order::edf) == responses{4ms, 7ms});
}

TEST_CASE("by deadlines, those that are alike are served as they come") {
  const session_group alike{{.wcet = 8ms, .period = 100ms, .deadline = 50ms},
                            4};
  CHECK(worst({alike}, queue_order::edf) == responses{32ms});
  CHECK(worst({alike}, queue_order::fifo) == responses{32ms});
  // One more that was under way: (8 + 4 · 8 − 8) / 2 + 8.
  CHECK(worst({alike}, queue_order::edf, 2) == responses{24ms});
  CHECK(worst({alike}, queue_order::fifo, 2) == responses{20ms});
}

TEST_CASE("on two workers the third job waits for one, not for two") {
  CHECK(worst({{{.wcet = 4ms, .period = 100ms}, 3}}, queue_order::fifo, 2)
        == responses{8ms});
}

TEST_CASE(
    "on two workers a job may find one of a session under way and the next "
    "one before it") {
  // The first session's may be 1 ms apart. What is behind both, and behind one
  // of its own: (4 + 4 + 2) / 2 + 2; the second one's own: (4 + 4) / 2 + 4.
  const session_group late{{.wcet = 4ms, .period = 10ms, .jitter = 9ms}};
  const session_group others{{.wcet = 2ms, .period = 100ms}, 2};
  CHECK(worst({late, others}, queue_order::fifo, 2) == responses{8ms, 7ms});
}

TEST_CASE("sessions that are alike count as so many groups") {
  const session_group one{eight_ms};
  const auto apart = worst({one, one, one, short_cycle}, queue_order::fifo, 2);
  const auto together =
      worst({{eight_ms, 3}, short_cycle}, queue_order::fifo, 2);
  REQUIRE(apart);
  REQUIRE(together);
  CHECK(apart->front() == together->front());
  CHECK(apart->back() == together->back());
}

TEST_CASE("without a rest there is no bound") {
  for (const auto order : {queue_order::fifo, queue_order::edf}) {
    CHECK(!worst({{eight_ms, 13}}, order));
    CHECK(worst({{eight_ms, 12}}, order));
    CHECK(!worst({{{.wcet = 5ms, .period = 10ms}, 2}}, order));
    CHECK(worst({{{.wcet = 5ms, .period = 10ms}, 2}}, order, 2));
  }
  CHECK(!response_quantiles(std::vector{session_group{eight_ms, 13}}, 1));
}

TEST_CASE("nobody waits where nobody computes") {
  CHECK(worst({}, queue_order::fifo) == responses{});
  CHECK(worst({{{.wcet = 0ms, .period = 10ms}, 9}}, queue_order::edf)
        == responses{0ms});
}

TEST_CASE("an overrun counts with all that may wait for it") {
  // p = 0.001, e = 0.1 ms; D = 1 − 0.1; 0.01 + 3 · 0.1 + 0.1 (1 + 2/0.9) ms.
  const std::vector<session_group> mix{
      {{.wcet = 10ms, .period = 100ms, .overrun = {1e-3, 1e-4}}}};
  const auto all = stated_responses(mix, 1);
  REQUIRE(all);
  CHECK(all->front().at_most == 10ms + 1ns);
  CHECK(all->front().later
        == doctest::Approx(0.001 + (0.01 + 0.3 + 0.1 * (1 + 2 / 0.9)) / 100));
}

TEST_CASE("what is stated is the worst case where no job overruns") {
  const std::vector<session_group> mix{{eight_ms, 5}};
  const auto all = stated_responses(mix, 1);
  REQUIRE(all);
  CHECK(all->front().at_most == 40ms);
  CHECK(all->front().later == 0);
}
