// Accounts of computing time, from outside.
#include "tests/processes/results_reader.hpp"
#include "tests/processes/workplace.hpp"

#include <algorithm>
#include <set>
#include <string>

using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

/// @returns how long planning for a vehicle was on this account.
double time_of(const fs::path& out, const std::string& station,
               const std::string& actor, const std::string& source) {
  for (const auto& r : rows_of(out / "cpu.csv"))
    if (r.at("station") == station && r.at("actor") == actor
        && r.at("service") == "trajectory_planning" && r.at("source") == source)
      return number(r, "time_s");
  return 0;
}

/// @returns how long planning was remote since second 1, when accounts begin.
double offloaded_s(const fs::path& out, const std::string& station) {
  auto sum_s = 0.0;
  for (const auto& e : episodes_of(out, "requester", "trajectory_planning"))
    if (e.at("station") == station && e.at("first_data_s") != "")
      sum_s += number(e, "ended_s") - std::max(1.0, number(e, "first_data_s"));
  return sum_s;
}

} // namespace

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
  for (const std::string actor : {"requester_manager", "service_instance"})
    for (const std::string station : {"101", "102"}) {
      CAPTURE(actor + " of " + station);
      const auto remote_s = time_of(out, station, actor, "remote");
      CHECK(remote_s
            == doctest::Approx(offloaded_s(out, station)).epsilon(0.1));
      CHECK(time_of(out, station, actor, "local") + remote_s
            == doctest::Approx(3).epsilon(0.05));
    }
  // Another run there has other results.
  at.drive("out", {"--duration", "1s", "--force"});
  CHECK_FALSE(fs::exists(out / "cpu.csv"));
}

TEST_CASE(
    "vehicles of config/paper/cpu.toml are offloaded for a part of the time") {
  const workplace at;
  const auto end =
      at.run_sofof({"run", "config/paper/cpu.toml", "--out", "out", "--quiet"});
  CAPTURE(end.err);
  REQUIRE(end.code == 0);
  const auto summary = summary_of(at / "out");
  CHECK(summary["episodes"] == 6);
  CHECK(summary["fallbacks"] == 0);
  CHECK(summary["offloaded_share"] > 0.3);
  CHECK(summary["offloaded_share"] < 0.65);
}
