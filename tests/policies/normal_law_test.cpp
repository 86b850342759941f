// Tests of the standard normal law.
#include "policies/algorithms/forecast/normal_law.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <utility>

using namespace sofof;
using namespace sofof::policies;
using test::near;

TEST_CASE("quantiles are those of tables, far out as well") {
  for (const auto& [p, x] : {std::pair{0.9, 1.2815515655446008},
                             {0.975, 1.9599639845400536},
                             {0.99, 2.3263478740408408},
                             {0.999, 3.090232306167813},
                             {1e-6, -4.753424308822899},
                             {1e-12, -7.034483825301132},
                             {1e-100, -21.27345356096532},
                             {1e-300, -37.0470962993612}})
    CHECK(normal_quantile(p) == near(x, 1e-13));
  CHECK(std::abs(normal_quantile(0.5)) < 1e-15);
}

TEST_CASE("a quantile has the probability that it was asked for") {
  for (double p = 1e-300; p < 0.5; p *= 1.7) {
    CHECK(normal_cdf(normal_quantile(p)) == near(p, 1e-12));
    CHECK(normal_quantile(1 - p) == -normal_quantile(1 - (1 - p)));
  }
}

TEST_CASE("certainty is infinitely far out, and nonsense is no number") {
  CHECK(normal_quantile(0) == -INFINITY);
  CHECK(normal_quantile(1) == INFINITY);
  CHECK(std::isnan(normal_quantile(-0.1)));
  CHECK(std::isnan(normal_quantile(1.1)));
  CHECK(std::isnan(normal_quantile(NAN)));
}
