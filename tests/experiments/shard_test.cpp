// Runs shared out among shards: whole, even, and always alike.
#include "experiments/sweep/shard.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

using namespace sofof;
using namespace sofof::experiments;

namespace {

std::vector<wanted_run> runs_of_cost(const std::vector<double>& costs) {
  std::vector<wanted_run> runs;
  for (const auto cost : costs)
    runs.emplace_back().cost = cost;
  return runs;
}

std::vector<double> random_costs(test::dice& roll, std::size_t count) {
  std::vector<double> costs(count);
  for (auto& cost : costs)
    cost = roll.between(1, 100);
  return costs;
}

/// @returns what each shard has to do.
std::vector<double> loads_of(const std::vector<wanted_run>& runs,
                             std::size_t shards) {
  std::vector<double> loads(shards);
  const auto shard_of = share_out(runs, shards);
  REQUIRE(shard_of.size() == runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i)
    loads.at(shard_of[i] - 1) += runs[i].cost;
  return loads;
}

} // namespace

TEST_CASE("a shard is I of N, and nothing else") {
  const auto is = [](std::string_view text, std::size_t number,
                     std::size_t of) {
    const auto which = parse_shard(text);
    return which && which->number == number && which->of == of;
  };
  CHECK(is("1/1", 1, 1));
  CHECK(is("7/7", 7, 7));
  CHECK(is("3/100000", 3, most_shards));
  CHECK(is("0+1/7", 1, 7));
  CHECK(is("6+1/7", 7, 7));
  for (const auto* text : {"",
                           "/",
                           "1",
                           "1/",
                           "/7",
                           "0/7",
                           "8/7",
                           "a/b",
                           "-1/7",
                           "1/7 ",
                           " 1/7",
                           "1/7/7",
                           "1.0/7",
                           "1/0",
                           "0/0",
                           "1/100001",
                           "7+1/7",
                           "+1/7",
                           "1+2/7",
                           "1+1",
                           "1+1+1/7",
                           "100000+1/100000",
                           "18446744073709551617/18446744073709551618"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_shard(text));
  }
}

TEST_CASE("shards of equal runs differ by one run at most") {
  for (const std::size_t count : {0, 1, 6, 7, 100})
    for (const std::size_t shards : {1, 2, 3, 7, 40}) {
      CAPTURE(count);
      CAPTURE(shards);
      const auto loads =
          loads_of(runs_of_cost(std::vector<double>(count, 1)), shards);
      const auto [least, most] = std::ranges::minmax(loads);
      CHECK(most - least <= 1);
    }
}

TEST_CASE("shards of runs of any length differ by one run at most") {
  test::dice roll{5};
  for (int k = 0; k < 200; ++k) {
    const auto costs =
        random_costs(roll, static_cast<std::size_t>(roll.between(1, 60)));
    const auto shards = static_cast<std::size_t>(roll.between(1, 12));
    const auto loads = loads_of(runs_of_cost(costs), shards);
    const auto [least, most] = std::ranges::minmax(loads);
    CHECK(most - least <= std::ranges::max(costs) + 1e-9);
  }
}

TEST_CASE("runs that are measured belong to the measuring shard, which gets "
          "the less of the others") {
  auto runs = runs_of_cost(std::vector<double>(30, 1));
  for (std::size_t i = 0; i < runs.size(); i += 5)
    runs[i].is_measured = true;
  for (const std::size_t shards : {1, 3, 5}) {
    CAPTURE(shards);
    const auto shard_of = share_out(runs, shards);
    for (std::size_t i = 0; i < runs.size(); i += 5)
      CHECK(shard_of[i] == measuring_shard);
    for (const auto load : loads_of(runs, shards))
      CHECK(load == doctest::Approx(30.0 / static_cast<double>(shards)));
  }
  // Where there are more shards than that, it has those that are measured.
  CHECK(loads_of(runs, 10).front() == 6);
}

TEST_CASE("the same runs are shared out alike, again and again") {
  test::dice roll{9};
  const auto runs = runs_of_cost(random_costs(roll, 500));
  const auto first = share_out(runs, 7);
  for (int k = 0; k < 5; ++k)
    CHECK(share_out(runs, 7) == first);
}
