// Runs in which programs decide.
#include "base/input_error.hpp"
#include "scenario/load.hpp"
#include "scenario/run.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"
#include "tests/support/mirror.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <sstream>
#include <string>

using namespace sofof;
using namespace sofof::scenario;
using namespace sofof::test;

namespace sofof::runs_of_programs {

namespace fs = std::filesystem;

constexpr auto town = R"(duration = "20s"
[street_grid]
[[fleet]]
count = 4
routes = ["block *"]
[[provider]]
position_m = [100.0, 50.0]
area_radius_m = 400.0
[[provider]]
name = "other"
position_m = [0.0, 0.0]
area_radius_m = 400.0
[network]
profile = "paper_sim"
[[service]]
name = "trajectory_planning"
planner = "lane_follow"
[policies]
codm = "always"
)";

struct driven_town {
  scratch at;
  std::atomic<bool> interrupted = false;

  driven_town() {
    write_text(at / "town.toml", town);
    write_text(at / "mirror.py", mirror_of_nearest);
  }

  void drive(const std::string& out, const std::vector<std::string>& set) {
    std::ostringstream console;
    run_options how;
    how.out = at / out;
    run(load_scenario(at / "town.toml", set), how, interrupted, console);
  }

  /// @returns what ends a run; the test ends if it leaves anything.
  std::string failure(const std::string& command, const std::string& more = {},
                      const std::string& side = "lodm") {
    try {
      drive("failed", {"policies." + side + "={name=\"process\",command='''"
                       + command + "'''" + more + "}"});
    } catch (const input_error&) {
      return "it was wrong input";
    } catch (const std::runtime_error& problem) {
      CHECK_FALSE(fs::exists(at / "failed"));
      return problem.what();
    }
    return "it went well";
  }

  std::string file(const std::string& name) const {
    return read_file(at / name);
  }
};

TEST_CASE_FIXTURE(driven_town, "a program that decides as nearest does gives "
                               "the same cycles and events, byte by byte, and "
                               "its results run again") {
  drive("nearest", {"policies.lodm=nearest"});
  drive("mirror", {R"(policies.lodm={name="process",)"
                   R"(command="/usr/bin/python3 mirror.py"})"});
  CHECK(file("nearest/cycles.csv").size() > 1000);
  CHECK(contains(file("nearest/events.jsonl"), "accept"));
  for (const auto* name : {"cycles.csv", "events.jsonl", "episodes.csv"}) {
    CAPTURE(name);
    CHECK(file(std::string{"mirror/"} + name)
          == file(std::string{"nearest/"} + name));
  }
  CHECK(file("mirror/lodm_program/mirror.py") == mirror_of_nearest);
  CHECK(contains(file("mirror/summary.json"), "\"mirror 1\""));
  fs::remove(at / "mirror.py");
  std::ostringstream console;
  run_options how;
  how.out = at / "again";
  run(load_scenario(at / "mirror/config.toml"), how, interrupted, console);
  CHECK(file("again/config.toml") == file("mirror/config.toml"));
  CHECK(file("again/cycles.csv") == file("nearest/cycles.csv"));
}

TEST_CASE_FIXTURE(driven_town, "a program that fails in any way ends the run "
                               "with a sentence, and leaves no results") {
  const auto greeted = [](const std::string& script) {
    return R"(/bin/sh -c "read a; echo '{\"sofof\":1,\"name\":\"x\"}'; )"
           + script + '"';
  };
  CHECK(contains(failure(greeted("read a; kill -9 \\$\\$")),
                 "was ended by signal 9"));
  CHECK(contains(failure(greeted("read a; echo no; read b")),
                 "answered ask 1 wrongly: it must be a JSON object: no"));
  CHECK(contains(failure(greeted("read a; read b"), ",time_limit=\"100ms\""),
                 "did not answer in time"));
  CHECK(contains(failure(greeted("read a; yes | tr -d '\\\\n'")),
                 "more than 65536 octets"));
  CHECK(contains(failure(greeted("read a; echo no; read b"), "", "codm"),
                 "policies.codm"));
  CHECK(contains(failure("/bin/false"), "exited with 1"));
  CHECK(failure("/bin/no_such") == "it was wrong input");
}

TEST_CASE_FIXTURE(driven_town, "a program of providers decides about requests "
                               "as a policy here does") {
  write_text(at / "always.sh", R"(read hello
echo '{"sofof":1,"name":"always"}'
while read line; do
  case $line in *'"type":"ask"'*) ;; *) continue;; esac
  n=$((n + 1))
  asked=$(echo "${line%%\"sessions\"*}" | grep -o '"station"' | wc -l)
  all='{"accept":true,"why":"always"}'
  while [ $asked -gt 1 ]; do
    all="$all,{\"accept\":true,\"why\":\"always\"}"
    asked=$((asked - 1))
  done
  echo "{\"n\":$n,\"requests\":[$all]}"
done
)");
  const std::string lodm = "policies.lodm=nearest";
  drive("always", {lodm, "policies.codm={name=\"always\"}"});
  drive("program", {lodm, R"(policies.codm={name="process",filter="none",)"
                          R"(command="/bin/sh always.sh"})"});
  CHECK(file("program/cycles.csv") == file("always/cycles.csv"));
  CHECK(file("program/events.jsonl") == file("always/events.jsonl"));
}

} // namespace sofof::runs_of_programs
