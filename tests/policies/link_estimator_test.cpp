// Tests of what to expect of a link.
#include "policies/algorithms/forecast/link_estimator.hpp"

#include "base/random.hpp"
#include "tests/support/at.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;
using test::at;
using test::near;

namespace {

// Messages every 100 ms, the last one received at `count` times that.
link_estimator steady(int count, duration latency) {
  link_estimator link;
  for (int k = 1; k <= count; ++k)
    link.arrived(at(k * 100ms - latency), at(k * 100ms));
  return link;
}

} // namespace

TEST_CASE("the first numbers weigh the same: plain mean and variance") {
  moving_normal law{0.05};
  for (const auto x : {1.0, 2.0, 3.0, 6.0})
    law.add(x);
  CHECK(law.mean() == near(3, 1e-12));
  CHECK(law.variance() == near(3.5, 1e-12));
}

TEST_CASE("a number that is older than 1/α fades by 1 - α with each new one") {
  moving_normal law{0.05};
  for (int k = 0; k < 100; ++k)
    law.add(0);
  law.add(1);
  CHECK(law.mean() == near(0.05, 1e-12));
  CHECK(law.variance() == near(0.95 * 0.05, 1e-12));
  law.add(0);
  CHECK(law.mean() == near(0.05 * 0.95, 1e-12));
}

TEST_CASE("what is no finite number teaches nothing") {
  moving_normal law{0.5};
  law.add(1);
  law.add(std::numeric_limits<double>::quiet_NaN());
  law.add(std::numeric_limits<double>::infinity());
  CHECK(law.count() == 1);
  CHECK(law.mean() == 1);
}

TEST_CASE("a law without spread is sure of itself") {
  moving_normal law{0.5};
  law.add(2);
  CHECK(law.probability_above(1.9) == 1);
  CHECK(law.probability_above(2) == 0);
  CHECK(law.quantile(0.999) == 2);
}

TEST_CASE("quantile and probability of a law belong together") {
  moving_normal law{0.1};
  for (int k = 0; k < 50; ++k)
    law.add(k % 7);
  for (const auto p : {0.001, 0.2, 0.5, 0.99})
    CHECK(law.probability_above(law.quantile(p)) == near(1 - p, 1e-9));
}

TEST_CASE("a steady link is known exactly") {
  const auto link = steady(20, 30ms);
  CHECK(link.latency_quantile(0.5) == 30ms);
  CHECK(to_seconds(link.gap_quantile(0.5).value()) == near(0.1, 1e-6));
  CHECK(link.late_probability(50ms, at(2s)) == 0);
  CHECK(link.late_probability(20ms, at(2s)) == 1);
  CHECK(link.gap_probability(150ms, at(2s)) == 0);
  CHECK(link.gap_probability(50ms, at(2s)) == 1);
}

TEST_CASE("a link of which nothing is known goes wrong for certain") {
  for (const auto& link : {link_estimator{}, steady(9, 1ms)}) {
    CHECK(link.stale(at(900ms)));
    CHECK(link.late_probability(10s, at(900ms)) == 1);
    CHECK(link.gap_probability(10s, at(900ms)) == 1);
    CHECK(!link.latency_quantile(0.5));
    CHECK(!link.gap_quantile(0.5));
  }
  CHECK(!steady(10, 1ms).stale(at(1s)));
}

TEST_CASE("after three silent periods a link goes wrong for certain, and one "
          "message makes it known again") {
  auto link = steady(100, 10ms);
  CHECK(!link.stale(at(10s + 299ms)));
  CHECK(link.late_probability(50ms, at(10s + 299ms)) == 0);
  CHECK(link.stale(at(10s + 301ms)));
  CHECK(link.late_probability(50ms, at(10s + 301ms)) == 1);
  CHECK(link.gap_probability(1s, at(10s + 301ms)) == 1);
  link.arrived(at(10'390ms), at(10'400ms));
  CHECK(!link.stale(at(10'400ms)));
  CHECK(link.late_probability(50ms, at(10'400ms)) == 0);
}

TEST_CASE("lost messages show as gaps") {
  const random_stream chance{1, "loss"};
  link_estimator link;
  time_point last;
  for (int k = 1; k <= 200; ++k)
    if (chance.uniform(k) > 0.4) {
      last = at(k * 100ms);
      link.arrived(last - 10ms, last);
    }
  CHECK(link.late_probability(50ms, last) == 0);
  CHECK(link.gap_probability(250ms, last) > 0.05);
}

TEST_CASE("messages before the last one and from the future do no harm") {
  auto link = steady(20, 30ms);
  link.arrived(at(100ms), at(1s));
  CHECK(link.latency_quantile(0.5) == 30ms);
  link.arrived(at(3s), at(2100ms));
  CHECK(link.late_probability(50ms, at(2100ms)) < 0.5);
  CHECK(std::isfinite(to_seconds(link.latency_quantile(0.999).value())));
}

TEST_CASE("a sender whose clock is ahead is heard at once") {
  const auto link = steady(20, -30ms);
  CHECK(!link.stale(at(2s)));
  CHECK(link.late_probability(1ms, at(2s)) == 0);
  CHECK(link.latency_quantile(0.99) == 1us);
}

TEST_CASE("a link that turns bad is known to be bad within two seconds") {
  const random_stream chance{2, "latency"};
  link_estimator link;
  for (int k = 1; k <= 400; ++k) {
    const auto centre = k <= 380 ? 20.0 : 60.0; // ms
    const auto latency =
        from_seconds(centre * 1e-3 * std::exp(chance.normal(0, 0.1, k)));
    link.arrived(at(k * 100ms) - latency, at(k * 100ms));
    if (k == 380)
      CHECK(link.late_probability(50ms, at(k * 100ms)) < 1e-6);
  }
  CHECK(link.late_probability(50ms, at(40s)) > 0.3);
}
