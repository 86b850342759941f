// Shards of a sweep: each makes its runs, and the sweep finds all of them.
#include "experiments/sweep/sharded_sweep.hpp"

#include "base/input_error.hpp"
#include "tests/experiments/made_up_sweep.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace sofof;
using namespace sofof::experiments;
using namespace sofof::scenario;
using namespace sofof::test;

namespace {

struct shards_of_four : sweep_of_four {
  std::vector<sweep_plan> plans() const {
    return {load_sweep(at / "four.toml")};
  }
  shard_outcome make(std::size_t number, std::size_t of) {
    return make_shard(plans(), options(), {number, of}, interrupted, console);
  }
};

} // namespace

TEST_CASE("shards make every run once, in any order, and no table") {
  shards_of_four four;
  std::size_t own = 0;
  for (const std::size_t number : {3, 1, 2}) {
    const auto outcome = four.make(number, 3);
    CHECK(outcome.all_good());
    CHECK(outcome.of_all == 4);
    CHECK(outcome.found == 0);
    CHECK(outcome.all() <= 2);
    own += outcome.all();
  }
  CHECK(own == 4);
  CHECK(four.made.seeds == std::multiset<std::int64_t>{1, 2, 3, 4});
  CHECK_FALSE(fs::exists(four.at / "out/four.csv"));
}

TEST_CASE("the sweep finds what shards have made, and makes what is missing") {
  shards_of_four whole, four;
  whole.run();
  four.make(2, 3);
  four.make(3, 3);
  const auto before = four.made.seeds.size();
  CHECK(before < 4);
  CHECK(four.run().good == 4);
  CHECK(four.made.seeds == std::multiset<std::int64_t>{1, 2, 3, 4});
  CHECK(four.table() == whole.table());
  CHECK(four.make(1, 3).all() == 4 - before); // found, by a late shard
  CHECK(four.made.seeds.size() == 4);
  CHECK(four.table() == whole.table());
}

TEST_CASE("a shard works beside a sweep in the same folder") {
  shards_of_four four;
  auto options = four.options();
  std::size_t beside = 0;
  options.make = [&](const scenario_definition& s, const fs::path& folder,
                     const std::atomic<bool>&) {
    if (s.seed == 1)
      beside = four.make(1, 1).good;
    four.made.make(s, folder);
  };
  CHECK(four.run(options).good == 4);
  CHECK(beside == 4);
  CHECK(four.made.seeds == std::multiset<std::int64_t>{1, 1, 2, 3, 4});
}

TEST_CASE("a shard with a run that fails says so, and others do not") {
  shards_of_four four;
  four.made.failing = 2;
  std::size_t failed = 0;
  for (const std::size_t number : {1, 2, 3})
    failed += four.make(number, 3).failed;
  CHECK(failed == 1);
  CHECK(four.console.str() == "point 2 (seed=2) failed: it must not be.\n");
}

TEST_CASE("what cannot be loaded is reported by the first shard alone") {
  shards_of_four four;
  std::ofstream{four.at / "four.toml"} << four_seeds << R"(
[[axis]]
key = "fleet.0.count"
values = [1, -1]
)";
  CHECK(four.make(2, 2).failed == 0);
  CHECK(four.console.str().empty());
  CHECK(four.make(1, 2).failed == 4);
  CHECK(four.console.str().find("--set fleet.0.count=-1") != std::string::npos);
}

TEST_CASE("an interrupted shard leaves no run of which it was in the middle") {
  shards_of_four four;
  four.interrupted = true;
  CHECK(four.make(1, 1).interrupted);
  CHECK(four.made.seeds.empty());
}

TEST_CASE("plans that share runs are counted, and shared out, together") {
  shards_of_four four;
  auto plans = four.plans();
  CHECK(count_runs(plans, "this", four.interrupted) == 4);
  plans.push_back(plans.front());
  plans.back().seeds = {3, 4, 5};
  CHECK(count_runs(plans, "this", four.interrupted) == 5);
  CHECK(
      make_shard(plans, four.options(), {1, 1}, four.interrupted, four.console)
          .good
      == 5);
}

TEST_CASE("the first seed of a plan that measures belongs to the first shard") {
  shards_of_four four;
  auto plans = four.plans();
  plans.front().measures = true;
  for (const std::size_t number : {2, 3, 4})
    make_shard(plans, four.options(), {number, 4}, four.interrupted,
               four.console);
  CHECK_FALSE(four.made.seeds.contains(1));
}

TEST_CASE("where a program decides, its runs are found again while it and its "
          "version are the same; without a version never, nor by shards") {
  shards_of_four four;
  const auto decides = [&](std::string_view version) {
    std::ofstream{four.at / "decides.sh"}
        << "read hello; echo '{\"sofof\":1,\"name\":\"mine\"" << version
        << "}'; read bye\n";
  };
  std::ofstream{four.at / "base.toml"}
      << four_base
      << "[policies]\nlodm = { name = \"process\", command = \"/bin/sh "
         "decides.sh\" }\n";
  decides(",\"version\":\"1\"");
  four.run();
  four.run();
  CHECK(four.made.seeds.size() == 4);
  CHECK(four.make(1, 1).found == 4);
  decides(",\"version\":\"2\"");
  four.run();
  CHECK(four.made.seeds.size() == 8);
  decides("");
  CHECK_THROWS_WITH_AS(four.make(1, 2), doctest::Contains("tells no version"),
                       input_error);
  CHECK(four.made.seeds.size() == 8);
}
