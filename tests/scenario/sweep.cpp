// Runs of a sweep: shared, found again, and put into one table.
#include "scenario/sweep/sweep.hpp"

#include "scenario/input_error.hpp"
#include "scenario/sweep/run_store.hpp"
#include "scenario/toml_file.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <mutex>
#include <set>
#include <sstream>

using namespace sofof;
namespace fs = std::filesystem;

namespace {

const std::string base = R"(name = "base"
duration = "1s"
[street_grid]
columns = 2
rows = 2
[[fleet]]
routes = ["block *"]
[[service]]
name = "trajectory_planning"
)";

const std::string four_seeds = R"(name = "four"
scenario = "base.toml"
seeds = 4
)";

/// Writes summaries instead of driving.
class made_up_runs {
public:
  void make(const scenario& s, const fs::path& folder) {
    const std::lock_guard lock{mutex_};
    seeds.insert(s.seed);
    if (s.seed == failing)
      throw std::runtime_error{"it must not be."};
    fs::create_directories(folder);
    std::ofstream{folder / "summary.json"} << summary(s);
  }

  std::multiset<std::int64_t> seeds; ///< Of all runs that were asked for.
  std::int64_t failing = 0;          ///< The run of this seed fails.
  double collisions = 0;             ///< Of each run.

private:
  std::string summary(const scenario& s) const {
    std::ostringstream text;
    text << R"({"scenario":"base","interrupted":false,"seed":)" << s.seed
         << R"(,"t_off_s":{"mean":)" << 1.5 * static_cast<double>(s.seed)
         << R"(},"safety":{"without_fresh_plan_s":0,"collisions":)"
         << collisions << R"(,"off_road_s":0},"wall_s":7})";
    return text.str();
  }

  std::mutex mutex_;
};

/// A folder with a sweep of four seeds.
struct sweep_of_four {
  test::scratch at;
  made_up_runs made;
  std::ostringstream console;
  std::atomic<bool> interrupted = false;

  sweep_of_four() {
    std::ofstream{at / "base.toml"} << base;
    std::ofstream{at / "four.toml"} << four_seeds;
  }

  sweep_options options() {
    sweep_options all;
    all.out = at / "out";
    all.program = "this";
    all.make = [this](const scenario& s, const fs::path& folder,
                      const std::atomic<bool>&) { made.make(s, folder); };
    return all;
  }

  sweep_outcome run(const sweep_options& with) {
    return sweep(load_sweep(at / "four.toml"), with, interrupted, console);
  }
  sweep_outcome run() { return run(options()); }

  std::string table() const { return read_text(at / "out/four.csv").value(); }
};

} // namespace

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
    if (run.is_directory() && torn++ < 2) {
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
  const run_store store{four.at / "out"};
  CHECK_THROWS_WITH_AS(four.run(),
                       doctest::Contains("another sweep is at work there"),
                       input_error);
}
