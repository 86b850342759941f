// Tests of optimisation by sampling.
#include "policies/algorithms/assignment/cross_entropy.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace sofof;
using namespace sofof::policies;

namespace {

const random_stream sample_draws{1, "samples"};

/// Each variable that equals its index modulo 3 scores.
double hits(std::span<const int> sample) {
  double result = 0;
  for (std::size_t v = 0; v < sample.size(); ++v)
    result += sample[v] == static_cast<int>(v % 3);
  return result;
}

} // namespace

TEST_CASE("sampling finds the one best of four to the thirtieth") {
  const std::vector<int> counts(30, 4);
  const auto found = cross_entropy(counts, hits, {}, sample_draws);
  CHECK(found.score == 30);
  CHECK(hits(found.categories) == 30);
}

TEST_CASE("later iterations know what earlier ones learned") {
  const std::vector<int> counts(30, 4);
  const auto blind = cross_entropy(
      counts, hits, {.samples = 6000, .iterations = 1}, sample_draws);
  CHECK(blind.score < 25);
}

TEST_CASE("the same stream finds the same, another one something else") {
  const std::vector<int> counts(30, 4);
  const cross_entropy_options short_search{.iterations = 3};
  const auto once = cross_entropy(counts, hits, short_search, sample_draws);
  const auto again = cross_entropy(counts, hits, short_search, sample_draws);
  const auto other =
      cross_entropy(counts, hits, short_search, random_stream{2, "samples"});
  CHECK(once.categories == again.categories);
  CHECK(once.categories != other.categories);
}

TEST_CASE("a sample that the score corrects is kept as corrected") {
  const std::vector<int> counts(5, 2);
  const auto at_most_two = [](std::span<int> sample) {
    int ones = 0;
    for (auto& category : sample)
      if (category == 1 && ++ones > 2)
        category = 0;
    return static_cast<double>(std::min(ones, 2));
  };
  const auto found = cross_entropy(counts, at_most_two, {}, sample_draws);
  CHECK(found.score == 2);
  CHECK(std::count(found.categories.begin(), found.categories.end(), 1) == 2);
}

TEST_CASE("variables with one category, or none to choose, are an optimum") {
  const std::vector<int> counts(3, 1);
  CHECK(cross_entropy(counts, hits, {}, sample_draws).categories
        == std::vector<int>{0, 0, 0});
  CHECK(cross_entropy({}, hits, {}, sample_draws).categories.empty());
}

TEST_CASE("inadmissible samples may score minus infinity") {
  const std::vector<int> counts(6, 2);
  const auto even = [](std::span<const int> sample) {
    const auto ones = std::count(sample.begin(), sample.end(), 1);
    return ones % 2 == 0 ? static_cast<double>(ones)
                         : -std::numeric_limits<double>::infinity();
  };
  CHECK(cross_entropy(counts, even, {}, sample_draws).score == 6);
}

TEST_CASE("a longer search is never worse, whatever it draws last") {
  const std::vector<int> counts(30, 4);
  double before = 0;
  for (int iterations = 1; iterations < 20; ++iterations) {
    const auto found = cross_entropy(
        counts, hits, {.samples = 10, .elite = 1, .iterations = iterations},
        sample_draws);
    CHECK(found.score >= before);
    CHECK(found.score == hits(found.categories));
    before = found.score;
  }
}
