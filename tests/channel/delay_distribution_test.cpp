// Tests of the distributions of delays.
#include "channel/delay_distribution.hpp"

#include "channel/channel_draws.hpp"

#include <doctest/doctest.h>

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
