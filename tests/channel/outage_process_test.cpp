// Stalls and fades: where they lie in time.
#include "channel/outage_process.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using test::near;
using namespace std::chrono_literals;

namespace {

outage_process some(std::uint64_t seed = 1) {
  return {random_stream{seed, "stalls"}, delay_distribution::exponential(9s),
          delay_distribution::uniform(500ms, 1500ms)};
}

} // namespace

TEST_CASE("without a law there are no interruptions") {
  outage_process none;
  CHECK(!none.at(time_point{}));
  CHECK(!none.at(time_point{1000h}));
}

TEST_CASE("interruptions lie where they lie, however often one asks") {
  auto often = some();
  auto seldom = some();
  for (auto t = time_point{}; t < time_point{500s}; t += 10ms) {
    const auto now = often.at(t);
    if (t.time_since_epoch() % 7s != 0s)
      continue;
    const auto same = seldom.at(t);
    REQUIRE(now.has_value() == same.has_value());
    if (now) {
      CHECK(now->number == same->number);
      CHECK(now->end == same->end);
    }
  }
}

TEST_CASE("an interruption lasts until its end, and not longer") {
  auto scout = some();
  auto t = time_point{};
  while (!scout.at(t))
    t += 10ms;
  const auto [number, end] = *scout.at(t);
  CHECK(number == 0);
  CHECK(scout.at(end - 1ns)->end == end);
  const auto next = scout.at(end);
  CHECK((!next || next->number == 1));
}

TEST_CASE("interruptions come at their rate and take their share of time") {
  auto stalls = some();
  std::uint64_t last = 0;
  auto inside = 0;
  constexpr auto steps = 1'000'000;
  for (auto i = 0; i < steps; ++i)
    if (const auto stall = stalls.at(time_point{i * 100ms})) {
      ++inside;
      CHECK(stall->number >= last);
      last = stall->number;
    }
  CHECK(last / 1e5 == near(0.1, 0.04)); // a second
  CHECK(inside / double{steps} == near(0.1, 0.04));
}

TEST_CASE("two vehicles are interrupted at times of their own") {
  auto a = some(1);
  auto b = some(2);
  auto both = 0;
  for (auto i = 0; i < 200'000; ++i)
    both += a.at(time_point{i * 100ms}) && b.at(time_point{i * 100ms});
  CHECK(both / 2e5 == near(0.01, 0.3));
}
