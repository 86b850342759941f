// A sweep of four seeds whose runs are made up, for tests of what is around
// them.
#pragma once

#include "base/options/toml_file.hpp"
#include "experiments/sweep/sweep.hpp"
#include "tests/support/scratch.hpp"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

namespace sofof::test {

namespace fs = std::filesystem;

inline const std::string four_base = R"(name = "base"
duration = "1s"
[street_grid]
columns = 2
rows = 2
[[fleet]]
routes = ["block *"]
[[service]]
name = "trajectory_planning"
)";

inline const std::string four_seeds = R"(name = "four"
scenario = "base.toml"
seeds = 4
)";

/// Writes summaries instead of driving.
class made_up_runs {
public:
  void make(const scenario::scenario_definition& s, const fs::path& folder) {
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
  std::string summary(const scenario::scenario_definition& s) const {
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
  scratch at;
  made_up_runs made;
  std::ostringstream console;
  std::atomic<bool> interrupted = false;

  sweep_of_four() {
    std::ofstream{at / "base.toml"} << four_base;
    std::ofstream{at / "four.toml"} << four_seeds;
  }

  experiments::sweep_options options() {
    experiments::sweep_options all;
    all.out = at / "out";
    all.program = "this";
    all.make = [this](const scenario::scenario_definition& s,
                      const fs::path& folder,
                      const std::atomic<bool>&) { made.make(s, folder); };
    return all;
  }

  experiments::sweep_outcome run(const experiments::sweep_options& with) {
    return experiments::sweep(experiments::load_sweep(at / "four.toml"), with,
                              interrupted, console);
  }
  experiments::sweep_outcome run() { return run(options()); }

  std::string table() const { return read_text(at / "out/four.csv").value(); }
};

} // namespace sofof::test
