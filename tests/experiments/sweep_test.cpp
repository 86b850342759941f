// Runs of a sweep: shared, found again, and put into one table.
#include "experiments/sweep/sweep.hpp"

#include "base/input_error.hpp"
#include "tests/experiments/made_up_sweep.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::experiments;
using namespace sofof::test;

TEST_CASE("every point is run once and becomes a line") {
  sweep_of_four four;
  const auto outcome = four.run();
  CHECK(outcome.good == 4);
  CHECK(outcome.all_good());
  CHECK(four.made.seeds == std::multiset<std::int64_t>{1, 2, 3, 4});
  std::istringstream lines{four.table()};
  std::string line;
  std::getline(lines, line);
  CHECK(line
        == "point,seed,status,run,scenario,t_off_s.mean,"
           "safety.without_fresh_plan_s,safety.collisions,safety.off_road_s");
  for (int seed = 1; seed <= 4; ++seed) {
    REQUIRE(std::getline(lines, line));
    CHECK(line.starts_with(std::to_string(seed) + "," + std::to_string(seed)
                           + ",ok,"));
    CHECK(line.find(seed == 3 ? ",4.5,0" : ",base,") != line.npos);
  }
}

TEST_CASE("a finished run is not run again, unless its program is another") {
  sweep_of_four four;
  four.run();
  const auto before = four.table();
  four.run();
  CHECK(four.made.seeds.size() == 4);
  CHECK(four.table() == before);
  auto newer = four.options();
  newer.program = "that";
  four.run(newer);
  CHECK(four.made.seeds.size() == 8);
}

TEST_CASE("an interrupted or torn run is run again") {
  sweep_of_four four;
  four.run();
  const auto before = four.table();
  auto torn = 0;
  for (const auto& run : fs::directory_iterator{four.at / "out/runs"})
    if (fs::exists(run.path() / "summary.json") && torn++ < 2) {
      const auto whole = read_text(run.path() / "summary.json").value();
      auto other = whole.substr(0, whole.size() / 2);
      if (torn == 2)
        (other = whole).replace(other.find("false"), 5, "true");
      std::ofstream{run.path() / "summary.json"} << other;
    }
  four.run();
  CHECK(four.made.seeds.size() == 6);
  CHECK(four.table() == before);
}

TEST_CASE("a point that fails is reported and stops nobody") {
  sweep_of_four four;
  four.made.failing = 2;
  const auto outcome = four.run();
  CHECK(outcome.good == 3);
  CHECK(outcome.failed == 1);
  CHECK_FALSE(outcome.all_good());
  CHECK(four.console.str() == "point 2 (seed=2) failed: it must not be.\n");
  CHECK(four.table().find("\n2,2,failed,") != std::string::npos);
}

TEST_CASE("a point that cannot be loaded is reported and stops nobody") {
  sweep_of_four four;
  std::ofstream{four.at / "four.toml"} << four_seeds << R"(
[[axis]]
key = "fleet.0.count"
values = [1, -1]
)";
  const auto outcome = four.run();
  CHECK(outcome.good == 4);
  CHECK(outcome.failed == 4);
  CHECK(four.console.str().find("--set fleet.0.count=-1") != std::string::npos);
}

TEST_CASE("a sweep of which no point can be loaded is refused as a whole") {
  sweep_of_four four;
  std::ofstream{four.at / "four.toml"} << four_seeds << "[set]\nno.such = 1\n";
  CHECK_THROWS_WITH_AS(
      four.run(),
      doctest::Contains("none of 4 points can be run; seed=1 because"),
      input_error);
  CHECK_FALSE(fs::exists(four.at / "out"));
}

TEST_CASE("points of one configuration share a run") {
  sweep_of_four four;
  std::ofstream{four.at / "four.toml"} << four_seeds << R"(
[[axis]]
name = "same"
[[axis.value]]
name = "one"
set = { "fleet.0.count" = 1 }
[[axis.value]]
name = "another"
set = { "fleet.0.count" = 1 }
)";
  CHECK(four.run().good == 8);
  CHECK(four.made.seeds.size() == 4);
}

TEST_CASE("a run that was unsafe is called so") {
  sweep_of_four four;
  four.made.collisions = 1;
  const auto outcome = four.run();
  CHECK(outcome.unsafe == 4);
  CHECK(four.table().find(",unsafe,") != std::string::npos);
}

TEST_CASE("an interrupted sweep writes no table") {
  sweep_of_four four;
  four.interrupted = true;
  CHECK(four.run().interrupted);
  CHECK_FALSE(fs::exists(four.at / "out/four.csv"));
}

TEST_CASE("two sweeps do not share a folder at the same time") {
  sweep_of_four four;
  fs::create_directories(four.at / "out/runs");
  const file_lock held{four.at / "out/runs/.lock"};
  CHECK_THROWS_WITH_AS(four.run(),
                       doctest::Contains("another sweep is at work there"),
                       input_error);
}
