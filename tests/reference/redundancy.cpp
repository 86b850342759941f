// Golden numbers of redundancy, measured with a prototype: latency lognormal
// with median 20 ms and σ = 0.5, 1 % lost, limit 50 ms; two providers whose
// links are independent of each other.
#include "base/random.hpp"
#include "offloading/first_response.hpp"
#include "policies/algorithms/forecast/normal_law.hpp"
#include "tests/support/joint_miss_probability.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;
using test::near;

namespace {

constexpr int cycles = 200'000;
constexpr duration latency_limit = 50ms;
constexpr duration cycle_period = 1s; // no answer is so late
constexpr duration lost = 999ms;
constexpr duration never = 1s; // the next cycle begins

duration latency(int cycle, std::uint32_t provider) {
  const random_stream chance{1, "redundancy"};
  if (chance.uniform(cycle, provider) < 0.01)
    return lost;
  const auto spread = chance.normal(0, 0.5, cycle, 2 + provider);
  return from_seconds(0.020 * std::exp(spread));
}

struct redundancy_row {
  std::string_view mode;
  duration hedge_after;
  double missed;
  double extra; // messages per cycle
  double p50_ms;
  double p99_ms;
  double p999_ms;
};

struct redundancy_outcome {
  double missed = 0;
  double extra = 0;
  std::vector<double> latency_ms; // sorted

  double quantile_ms(double p) const {
    return latency_ms[static_cast<std::size_t>(p * cycles)];
  }
};

// What happens in the order in which it happens, cycle by cycle.
redundancy_outcome drive_hedged(duration hedge_after) {
  offloading::first_response responses{cycle_period};
  redundancy_outcome seen;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    const auto sent = time_point{cycle * cycle_period};
    auto used = lost;
    const auto answer = [&](duration after) {
      if (after < lost && responses.use(sent))
        used = after;
    };
    const auto first = latency(cycle, 0);
    if (first <= hedge_after)
      answer(first);
    if (hedge_after < never
        && responses.hedge_due(sent, sent + hedge_after, hedge_after)) {
      ++seen.extra;
      const auto second = latency(cycle, 1);
      const auto late = second < lost ? hedge_after + second : lost;
      answer(std::min(first, late));
      answer(std::max(first, late));
    }
    seen.missed += used > latency_limit ? 1 : 0;
    seen.latency_ms.push_back(to_milliseconds(used));
  }
  seen.missed /= cycles;
  seen.extra /= cycles;
  std::ranges::sort(seen.latency_ms);
  return seen;
}

// P(no answer within t), in closed form.
double silent(double t_ms) {
  return 0.01 + 0.99 * normal_cdf(-std::log(t_ms / 20) / 0.5);
}

} // namespace

TEST_CASE("one provider, two, and a hedge miss as many cycles as in the "
          "table") {
  const redundancy_row rows[]{
      {"single", never, .0432, 0, 20.1, 999, 999},
      {"duplicate", 0ms, .0018, 1.0, 15.3, 38.8, 54.4},
      {"hedge 20 ms", 20ms, .0094, .505, 20.1, 49.6, 66.6},
      {"hedge 25 ms", 25ms, .0144, .334, 20.1, 52.4, 69.9},
      {"hedge 30 ms", 30ms, .0218, .217, 20.1, 55.2, 73.3}};
  for (const auto& row : rows) {
    CAPTURE(row.mode);
    const auto seen = drive_hedged(row.hedge_after);
    MESSAGE(row.mode << ": missed " << seen.missed << ", extra " << seen.extra
                     << ", p50 " << seen.quantile_ms(0.5) << ", p99 "
                     << seen.quantile_ms(0.99) << ", p99.9 "
                     << seen.quantile_ms(0.999));
    const auto four_sigma = 4 * std::sqrt(row.missed / cycles);
    CHECK(std::abs(seen.missed - row.missed) < four_sigma + 1e-4);
    CHECK(std::abs(seen.extra - row.extra) < 0.005);
    CHECK(seen.quantile_ms(0.5) == near(row.p50_ms, 0.02));
    CHECK(seen.quantile_ms(0.99) == near(row.p99_ms, 0.02));
    CHECK(seen.quantile_ms(0.999) == near(row.p999_ms, 0.05));
  }
}

TEST_CASE("the table agrees with closed form") {
  const auto single = silent(50);
  CHECK(single == near(.0432, 0.005));
  CHECK(joint_miss_probability(std::array{single, single}) == near(.0018, .05));
  CHECK(joint_miss_probability(std::array{single, silent(30)})
        == near(.0094, 0.01));
  CHECK(silent(20) == near(.505, 0.001));
}
