// Tests of the distributions of delays.
#include "channel/delay_distribution.hpp"

#include "channel/channel_draws.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using namespace std::chrono_literals;

TEST_CASE("mean and deviation of a law are those of its draws") {
  const std::vector<std::pair<std::string, delay_distribution>> laws{
      {"none", {}},
      {"uniform", delay_distribution::uniform(5ms, 25ms)},
      {"exponential", delay_distribution::exponential(7ms)},
      {"lognormal", delay_distribution::lognormal(3ms, 10ms, 4ms)},
      {"lognormal about", delay_distribution::lognormal_about(3ms, 10ms, 0.4)},
      {"beta", delay_distribution::beta(45ms, 0.646, 2.11)}};
  const random_stream noise{1, "means"};
  constexpr int draws = 40000;
  for (const auto& [name, law] : laws) {
    CAPTURE(name);
    double sum = 0, squares = 0;
    for (std::uint64_t k = 0; k < draws; ++k) {
      const auto x = law.draw_s(noise, k, 0);
      sum += x;
      squares += x * x;
    }
    const auto mean = sum / draws;
    CHECK(law.mean_s() == doctest::Approx(mean).epsilon(0.015));
    CHECK(law.deviation_s()
          == doctest::Approx(std::sqrt(squares / draws - mean * mean))
                 .epsilon(0.03));
  }
}

TEST_CASE("draws that depend on each other keep their law") {
  const auto law = delay_distribution::beta(45ms, 0.646, 2.11);
  const auto kept = law.kept(0.9);
  const random_stream noise{1, "kept"};
  constexpr std::uint64_t draws = 400'000;
  double sum = 0, squares = 0, products = 0, before = 0;
  for (std::uint64_t k = 0; k < draws; ++k) {
    const auto x = kept.draw_s(noise, k, 0);
    sum += x;
    squares += x * x;
    products += x * before;
    before = x;
  }
  const auto mean = sum / draws;
  const auto variance = squares / draws - mean * mean;
  CHECK(law.mean_s() == doctest::Approx(mean).epsilon(0.03));
  CHECK(law.deviation_s()
        == doctest::Approx(std::sqrt(variance)).epsilon(0.03));
  CHECK((products / draws - mean * mean) / variance
        == doctest::Approx(0.9).epsilon(0.02));
}

TEST_CASE("a profile's constant delay is on top of all draws, each way") {
  for (const auto name : channel_profile_names()) {
    CAPTURE(name);
    auto profile = *find_channel_profile(name);
    profile.trace = {{0, 0.010}, {1, 0.020}};
    const auto made = [&] {
      return channel_draws{std::make_shared<const channel_profile>(profile),
                           random_stream{1, "network"}, 101, 0};
    };
    const auto plain = made();
    profile.more_delay = 30ms;
    const auto more = made();
    for (std::uint64_t k = 0; k < 20; ++k)
      for (const auto direction : {direction::up, direction::down}) {
        const message_id id{direction, message_class::result, k};
        CHECK(more.network_delay(id, {}) - plain.network_delay(id, {}) == 30ms);
      }
  }
}

TEST_CASE("no draw of a law that ends exceeds its bound, and some come near") {
  const random_stream noise{1, "bounds"};
  for (const auto& law :
       {delay_distribution{}, delay_distribution::uniform(5ms, 25ms),
        delay_distribution::beta(45ms, 0.646, 2.11).kept(0.5)}) {
    const auto bound = law.bound();
    CHECK(bound.probability == 0);
    CHECK(bound.beyond_s == 0);
    double longest_s = 0;
    for (std::uint64_t k = 0; k < 20000; ++k)
      longest_s = std::max(longest_s, law.draw_s(noise, k, 0));
    CHECK(longest_s <= bound.at_most_s);
    CHECK(longest_s >= 0.95 * bound.at_most_s);
  }
}

TEST_CASE(
    "one in a hundred thousand draws of an endless law exceeds its bound, "
    "by what the law says") {
  // Of the log-normal law with this mean and deviation.
  const auto variance = std::log1p(0.16);
  const auto middle = std::log(10e-3) - variance / 2;
  const auto above = [&](double x_s) {
    return std::erfc((std::log(x_s) - middle) / std::sqrt(2 * variance)) / 2;
  };
  const auto bound = delay_distribution::lognormal(3ms, 10ms, 4ms).bound();
  const auto at_s = bound.at_most_s - 3e-3;
  CHECK(above(at_s) == doctest::Approx(rare).epsilon(1e-6));
  CHECK(bound.probability == rare);
  double beyond_s = 0; // ∫ P(X > x) dx
  constexpr double step_s = 1e-6;
  for (auto x_s = at_s; x_s < 1; x_s += step_s)
    beyond_s += above(x_s + step_s / 2) * step_s;
  CHECK(bound.beyond_s == doctest::Approx(beyond_s).epsilon(1e-3));

  const auto other = delay_distribution::exponential(7ms).bound();
  CHECK(std::exp(-other.at_most_s / 7e-3) == doctest::Approx(rare));
  CHECK(other.beyond_s == doctest::Approx(7e-3 * rare));
}
