// Draws that are addressed, not generated in turn.
#include "base/random.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <vector>

using namespace sofof;
using test::near;

namespace {

constexpr std::uint64_t draw_count = 200'000;

struct moments {
  double mean = 0;
  double sd = 0;
};

template <class Draw>
moments moments_of(Draw draw) {
  double sum = 0;
  double squares = 0;
  for (std::uint64_t n = 0; n < draw_count; ++n) {
    const double x = draw(n);
    sum += x;
    squares += x * x;
  }
  const auto mean = sum / draw_count;
  return {mean, std::sqrt(squares / draw_count - mean * mean)};
}

template <class Draw>
double share_below(double limit, Draw draw) {
  double below = 0;
  for (std::uint64_t n = 0; n < draw_count; ++n)
    below += draw(n) < limit;
  return below / draw_count;
}

// Of numbers that are uniform in (0, 1); 0 ± 0.0022 (one sd) when independent.
template <class A, class B>
double correlation(A a, B b) {
  double sum = 0;
  for (std::uint64_t n = 0; n < draw_count; ++n)
    sum += (a(n) - 0.5) * (b(n) - 0.5);
  return sum / draw_count * 12;
}

constexpr auto noise = 0.01; // over 4 standard deviations

} // namespace

TEST_CASE("a draw is the same in every run of every build") {
  const random_stream s{42, "radio"};
  CHECK(s.bits(0) == 8369121577004370561u);
  CHECK(s.bits(7, 3) == 5202613781812642330u);
  CHECK(s.part("up").bits(0) == 18187340360350983644u);
  CHECK(s.part(5).bits(0) == 10857217787685655372u);
}

TEST_CASE("a draw changes with seed, name, part, counter and lane") {
  const random_stream s{42, "radio"};
  const std::set<std::uint64_t> all{
      s.bits(1),
      s.bits(2),
      s.bits(1, 1),
      random_stream{43, "radio"}.bits(1),
      random_stream{42, "video"}.bits(1),
      s.part(1).bits(1),
      s.part(2).bits(1),
      s.part("1").bits(1),
      s.part(1).part(2).bits(1),
      s.part(2).part(1).bits(1),
  };
  CHECK(all.size() == 10);
}

TEST_CASE("a draw does not depend on the draws before it") {
  const random_stream s{1, "x"};
  const auto alone = s.beta(0.646, 2.11, 1000);
  for (std::uint64_t n = 0; n < 1000; ++n)
    s.beta(0.646, 2.11, n);
  CHECK(s.beta(0.646, 2.11, 1000) == alone);
}

TEST_CASE("a flipped bit of the counter flips half of the bits drawn") {
  const random_stream s{1, "x"};
  for (auto bit = 0; bit < 64; ++bit) {
    auto flips = 0;
    for (std::uint64_t n = 0; n < 1000; ++n)
      flips += std::popcount(s.bits(n) ^ s.bits(n ^ (1ULL << bit)));
    CHECK(flips / 1000.0 == near(32, 0.02));
  }
}

TEST_CASE("uniform draws fill their interval evenly and avoid its ends") {
  const random_stream s{1, "x"};
  std::array<double, 100> cells{};
  for (std::uint64_t n = 0; n < draw_count; ++n) {
    const auto u = s.uniform(n);
    REQUIRE(u > 0);
    REQUIRE(u < 1);
    ++cells[static_cast<std::size_t>(u * 100)];
  }
  double chi_squared = 0;
  for (const auto count : cells)
    chi_squared +=
        std::pow(count - draw_count / 100.0, 2) / (draw_count / 100.0);
  CHECK(chi_squared > 55); // 99 degrees of freedom: 0.01 % on either side
  CHECK(chi_squared < 157);
  CHECK(s.uniform(-2, 6, 5) == -2 + 8 * s.uniform(5));
}

TEST_CASE("neighbours in counter, lane, part and seed are uncorrelated") {
  const random_stream s{1, "x"};
  const auto u = [&](std::uint64_t n) { return s.uniform(n); };
  const auto other_seed = random_stream{2, "x"};
  CHECK(std::abs(correlation(u, u) - 1) < noise);
  for (std::uint64_t lag : {1, 2, 3, 64, 1024})
    CHECK(std::abs(correlation(u, [&](auto n) { return s.uniform(n + lag); }))
          < noise);
  for (std::uint32_t lane : {1, 2, 3, 4})
    CHECK(std::abs(correlation(u, [&](auto n) { return s.uniform(n, lane); }))
          < noise);
  CHECK(std::abs(correlation([&](auto n) { return s.part(n).uniform(0); },
                             [&](auto n) { return s.part(n + 1).uniform(0); }))
        < noise);
  CHECK(std::abs(correlation(u, [&](auto n) { return other_seed.uniform(n); }))
        < noise);
}

TEST_CASE("normal draws have a normal distribution") {
  const random_stream s{1, "x"};
  const auto draw = [&](std::uint64_t n) { return s.normal(3, 2, n); };
  const auto m = moments_of(draw);
  CHECK(m.mean == near(3, noise));
  CHECK(m.sd == near(2, noise));
  CHECK(share_below(1, draw) == near(0.15866, 0.03));
  CHECK(share_below(7, draw) == near(0.97725, 0.002));
}

TEST_CASE("exponential draws have the mean asked for and no memory") {
  const random_stream s{1, "x"};
  const auto draw = [&](std::uint64_t n) { return s.exponential(0.2, n); };
  const auto m = moments_of(draw);
  CHECK(m.mean == near(0.2, noise));
  CHECK(m.sd == near(0.2, noise));
  CHECK(share_below(0.2, draw) == near(0.63212, noise));
}

TEST_CASE("log-normal draws have the mean and deviation of the value") {
  const random_stream s{1, "x"};
  const auto draw = [&](std::uint64_t n) { return s.lognormal(3.74, 2.8, n); };
  const auto m = moments_of(draw);
  CHECK(m.mean == near(3.74, noise));
  CHECK(m.sd == near(2.8, 0.02));
  const auto median = 3.74 / std::hypot(1, 2.8 / 3.74);
  CHECK(share_below(median, draw) == near(0.5, noise));
}

TEST_CASE("beta draws have the moments of their shapes") {
  const random_stream s{1, "x"};
  struct shapes {
    double a, b;
  };
  for (const auto [a, b] :
       {shapes{0.646, 2.11}, shapes{0.5, 0.5}, shapes{1, 1}, shapes{3, 0.7},
        shapes{20, 30}, shapes{0.05, 0.05}}) {
    const auto m = moments_of([&](std::uint64_t n) { return s.beta(a, b, n); });
    const auto mean = a / (a + b);
    const auto sd = std::sqrt(mean * (1 - mean) / (a + b + 1));
    CHECK(m.mean == near(mean, noise));
    CHECK(m.sd == near(sd, noise));
  }
  // For b = 1 the distribution function is x^a.
  CHECK(share_below(0.3, [&](auto n) { return s.beta(2, 1, n); })
        == near(0.09, 0.03));
  CHECK(share_below(0.3, [&](auto n) { return s.beta(0.6, 1, n); })
        == near(std::pow(0.3, 0.6), noise));
}
