// Accounts of computing time, from outside.
#include "tests/processes/results_reader.hpp"
#include "tests/processes/workplace.hpp"

#include <set>

using namespace sofof::test;
namespace fs = std::filesystem;

TEST_CASE("computing time is not measured where none passes") {
  const workplace at;
  const auto before = at.inventory();
  const auto end = at.run_sofof({"run", scenario_file, "--cpu"});
  CHECK(end.code == 2);
  CHECK(end.out == "");
  CHECK(end.err.find("--realtime") != end.err.npos);
  CHECK(at.inventory() == before);
}

TEST_CASE("every vehicle has accounts of its planner and its offloading") {
  const workplace at;
  const auto out = at.drive("out", {"--realtime", "--cpu", "--duration", "4s"});
  std::set<std::string> planned, offloaded, watched;
  double actors_s = 0, process_s = 0;
  for (const auto& r : rows_of(out / "cpu.csv")) {
    const auto& actor = r.at("actor");
    const auto cpu_s = number(r, "cpu_s");
    if (actor == "(process)")
      process_s = cpu_s;
    else if (actor != "(measuring)")
      actors_s += cpu_s;
    if (r.at("station").empty())
      continue;
    CHECK((r.at("source") == "local" || r.at("source") == "remote"));
    CHECK(cpu_s <= number(r, "time_s"));
    if (r.at("service") == "trajectory_planning" && cpu_s > 0) {
      if (actor == "service_instance")
        planned.insert(r.at("station"));
      else if (actor == "requester_manager")
        offloaded.insert(r.at("station"));
      else if (actor == "qos_watchdog")
        watched.insert(r.at("station"));
    }
  }
  CHECK(planned.size() == 6);
  CHECK(offloaded.size() == 6);
  CHECK(watched.size() >= 1); // 102 starts in the area
  CHECK(actors_s > 0);
  CHECK(actors_s < process_s);
  // Another run there has other results.
  at.drive("out", {"--duration", "1s", "--force"});
  CHECK_FALSE(fs::exists(out / "cpu.csv"));
}

TEST_CASE("half of the time of config/paper/cpu.toml is offloaded") {
  const workplace at;
  const auto end =
      at.run_sofof({"run", "config/paper/cpu.toml", "--out", "out", "--quiet"});
  CAPTURE(end.err);
  REQUIRE(end.code == 0);
  const auto summary = summary_of(at / "out");
  CHECK(summary["episodes"] == 6);
  CHECK(summary["fallbacks"] == 0);
  CHECK(summary["offloaded_share"] > 0.4);
  CHECK(summary["offloaded_share"] < 0.65);
}
