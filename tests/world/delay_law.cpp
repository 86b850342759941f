// Tests of the distributions of delays.
#include "world/delay_law.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace sofof;
using namespace std::chrono_literals;

TEST_CASE("mean and deviation of a law are those of its draws") {
  const std::vector<std::pair<std::string, delay_law>> laws{
      {"none", {}},
      {"uniform", delay_law::uniform(5ms, 25ms)},
      {"exponential", delay_law::exponential(7ms)},
      {"lognormal", delay_law::lognormal(3ms, 10ms, 4ms)},
      {"lognormal about", delay_law::lognormal_about(3ms, 10ms, 0.4)},
      {"beta", delay_law::beta(45ms, 0.646, 2.11)}};
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
