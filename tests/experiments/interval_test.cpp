// Intervals of shares and means against what others have published, and against
// each other.
#include "experiments/dehler2025/mean_interval.hpp"
#include "experiments/dehler2025/normal_interval.hpp"
#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/dehler2025/share_interval.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace sofof::experiments::study {

using test::near;

namespace {

/// So many groups of the value 1 of so many, the others of 0.
std::vector<group> zeros_and_ones(int ones, int of) {
  std::vector<group> all;
  for (int i = 0; i < of; ++i)
    all.push_back({i < ones ? 1.0 : 0.0, 1});
  return all;
}

/// Runs of three vehicles that pass once, the first ones with an early end in
/// each pass.
std::vector<run_episodes> three_cars(int runs, int with) {
  std::vector<run_episodes> all;
  for (int i = 0; i < runs; ++i)
    all.push_back(i < with ? run_episodes{206.4, 6, 3, 0.0573}
                           : run_episodes{209.4, 3, 0, 0.0582});
  return all;
}

} // namespace

TEST_CASE("the interval of a share is Clopper and Pearson's") {
  // R's binom.test: 9 of 24, and 682 of 925 (Conover 1971, p. 97).
  const auto some = share_interval(9, 24);
  CHECK(some.mean == 0.375);
  CHECK(some.low == near(0.1879929, 1e-6));
  CHECK(some.high == near(0.5940636, 1e-6));
  const auto many = share_interval(682, 925);
  CHECK(many.low == near(0.7076683, 1e-6));
  CHECK(many.high == near(0.7654066, 1e-6));
}

TEST_CASE("Student's t is that of the tables, and of few runs bounds a mean") {
  // Abramowitz & Stegun, table 26.10.
  CHECK(student_t_95(1) == near(12.706, 1e-3));
  CHECK(student_t_95(2) == near(4.303, 1e-3));
  CHECK(student_t_95(4) == near(2.776, 1e-3));
  CHECK(student_t_95(9) == near(2.262, 1e-3));
  CHECK(student_t_95(30) == near(2.042, 1e-3));
  const std::vector<group> three{{1, 1}, {2, 1}, {3, 1}, {0, 0}};
  const auto x = normal_mean_interval(three).value();
  CHECK(x.mean == 2);
  CHECK(x.high - x.mean == near(4.303 / std::sqrt(3.0), 1e-3));
  CHECK(x.mean - x.low == near(x.high - x.mean, 1e-12));
  CHECK_FALSE(normal_mean_interval({}));
  CHECK_FALSE(normal_mean_interval(std::vector<group>{{4, 2}}));
}

TEST_CASE("no event of many bounds a share, and all of many too") {
  // (1 - p)^n = 0.025.
  for (const std::uint64_t n : {1U, 10U, 300U}) {
    const auto bound = 1 - std::pow(0.025, 1.0 / static_cast<double>(n));
    CHECK(share_interval(0, n).low == 0);
    CHECK(share_interval(0, n).high == near(bound, 1e-9));
    CHECK(share_interval(n, n).low == near(1 - bound, 1e-9));
    CHECK(share_interval(n, n).high == 1);
  }
}

TEST_CASE("a weighted mean is that of all values, not of the groups' means") {
  const group groups[] = {{10, 1}, {0, 9}};
  CHECK(mean_interval(groups)->mean == 1);
  CHECK_FALSE(mean_interval({}));
  CHECK_FALSE(mean_interval(std::vector<group>{{0, 0}}));
}

TEST_CASE("the interval of one group is its mean, as nothing else is known") {
  const group one[] = {{6, 3}};
  CHECK(mean_interval(one)->low == 2);
  CHECK(mean_interval(one)->high == 2);
}

TEST_CASE("of two values the interval of a mean is that of a share") {
  // So neither 92 % nor 98 % pass for 95 %: of 40 they end at 0.077 and 0.104.
  const group_weights weights{40, 20'000};
  const group zero{0, 1}, one{1, 1};
  for (const int ones : {0, 1, 5, 20, 40}) {
    CAPTURE(ones);
    const auto exact = share_interval(static_cast<std::uint64_t>(ones), 40);
    const auto x =
        mean_interval(zeros_and_ones(ones, 40), {zero, one}, weights).value();
    CHECK(x.mean == exact.mean);
    CHECK(std::abs(x.low - exact.low) < 0.004);
    CHECK(std::abs(x.high - exact.high) < 0.004);
  }
}

TEST_CASE("runs are drawn, not what is in them") {
  // Ten runs of a hundred values, alike within a run: as sure as ten values.
  std::vector<group> ten, thousand;
  for (int i = 0; i < 10; ++i) {
    ten.push_back({100.0 * i, 100});
    thousand.insert(thousand.end(), 100, {1.0 * i, 1});
  }
  CHECK(mean_interval(ten)->half_width() > 1.5);
  CHECK(mean_interval(thousand)->half_width() < 0.3);

  std::vector<run_episodes> runs;
  for (int i = 0; i < 10; ++i)
    runs.push_back({100.0 * i, 100, 90, 1});
  CHECK(mean_t_off(runs)->half_width() > 1.5);
  CHECK(early_ends_per_hour(runs)->low == near(90, 1e-9));
}

TEST_CASE("ten runs without an early end tell little of those to come") {
  // Ten seeds of three cars gave 69.8 s each time; a hundred gave 67.3 s.
  const auto ten = mean_t_off(three_cars(10, 0)).value();
  CHECK(ten.mean == near(69.8, 1e-9));
  CHECK(ten.low < 67.3);
  CHECK(ten.high == near(69.8, 1e-9));
  CHECK(early_ends_per_hour(three_cars(10, 0))->low == 0);
  CHECK(early_ends_per_hour(three_cars(10, 0))->high > 10);
  const auto hundred = mean_t_off(three_cars(100, 8)).value();
  CHECK(hundred.mean == near(64.5, 0.1));
  CHECK(hundred.low > 60);
}

TEST_CASE("runs that all have an early end tell little of those without") {
  const auto all = mean_t_off(three_cars(10, 10)).value();
  CHECK(all.low == near(34.4, 1e-9));
  CHECK(all.high > 40);
}

TEST_CASE("who asks for more runs is not calmed by three early ends") {
  const auto runs = three_cars(20, 3);
  CHECK(cautious_t_off(runs)->half_width() >= mean_t_off(runs)->half_width());
  CHECK(needs_more_runs(runs, {}));
  CHECK(needs_more_runs(three_cars(10, 0), {}));
  CHECK_FALSE(needs_more_runs(three_cars(40, 0), {}));
  CHECK(needs_more_runs(three_cars(40, 0), full_rule));
  CHECK_FALSE(needs_more_runs({{{0.5, 50, 50, 0.1}, {0.6, 60, 60, 0.1}}}, {}));
  CHECK(needs_more_runs({}, {}));
}

} // namespace sofof::experiments::study
