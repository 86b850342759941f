// The results of half an hour in Ulm-Lehr: complete, and they add up.
#include "tests/processes/laps.hpp"
#include "tests/processes/results_reader.hpp"
#include "tests/processes/workplace.hpp"
#include "tests/support/near.hpp"

#include <algorithm>
#include <memory>
#include <set>

using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

constexpr auto rounding = 1e-6;

/// Half an hour, driven once for all tests.
const fs::path& half_an_hour() {
  static const workplace at;
  static const auto folder = at.drive("out", {"--duration", "1800s"});
  return folder;
}

/// @returns the columns that docs/results.md lists for a file, in order.
std::vector<std::string> documented_columns(const std::string& file) {
  std::vector<std::string> names;
  auto in_section = false;
  for (const auto& line :
       lines_of(fs::path{SOFOF_SOURCE_DIR} / "docs/results.md")) {
    if (line.starts_with("## "))
      in_section = line == "## " + file;
    if (!in_section || !line.starts_with("| `"))
      continue;
    const auto cell = line.substr(0, line.find('|', 1));
    for (auto from = cell.find('`'); from != cell.npos;) {
      const auto to = cell.find('`', from + 1);
      names.push_back(cell.substr(from + 1, to - from - 1));
      from = cell.find('`', to + 1);
    }
  }
  return names;
}

double mean(const std::vector<row>& rows, const std::string& column) {
  double sum = 0;
  for (const auto& r : rows)
    sum += number(r, column);
  return sum / static_cast<double>(rows.size());
}

double largest(const std::vector<row>& rows, const std::string& column) {
  double most = 0;
  for (const auto& r : rows)
    most = std::max(most, number(r, column));
  return most;
}

} // namespace

TEST_CASE("the files have the columns that are documented") {
  for (const std::string file : {"episodes.csv", "cycles.csv", "tracks.csv",
                                 "vehicles.csv", "energy.csv"}) {
    CAPTURE(file);
    const auto columns = documented_columns(file);
    CHECK(columns.size() > 10);
    CHECK(fields_of(lines_of(half_an_hour() / file).front()) == columns);
    CHECK(ends_with_a_whole_line(half_an_hour() / file));
  }
  CHECK(lines_of(half_an_hour() / "timing.csv").front() == "figure,value");
}

TEST_CASE("half an hour in Ulm-Lehr is safe") {
  const auto safety = summary_of(half_an_hour())["safety"];
  CHECK(safety["driven_s"] == 6 * 1800.0);
  CHECK(safety["collisions"] == 0);
  CHECK(safety["without_fresh_plan_s"] == 0.0);
  CHECK(safety["off_road_s"] == 0.0);
  for (const auto& r : rows_of(half_an_hour() / "tracks.csv"))
    REQUIRE(number(r, "plan_age_ms") <= 200);
}

TEST_CASE("half an hour in Ulm-Lehr is smooth") {
  const auto summary = summary_of(half_an_hour());
  const auto& plans = summary["plans"];
  CHECK(plans["safe_stops"] == 0);
  CHECK(plans["max_lateral_accel_mps2"] <= 2.5 * 1.02);
  CHECK(plans["max_jerk_mps3"] <= 1.5 * 1.02);
  const auto& driving = summary["driving"];
  CHECK(driving["max_lateral_accel_mps2"] <= 2.5 * 1.1);
  CHECK(driving["max_jerk_mps3"] <= 1.5 * 1.25);
  CHECK(driving["hard_brakes"] == 0);
}

TEST_CASE("every change of source shows in the plans, without a jolt") {
  std::map<std::string, int> switched;
  for (const auto& line : lines_of(half_an_hour() / "events.jsonl")) {
    const auto event = nlohmann::json::parse(line);
    const std::string detail = event["detail"];
    if (event["service"] == "trajectory_planning")
      ++switched[event["what"].get<std::string>() + " "
                 + detail.substr(0, detail.find(' '))];
  }
  CHECK(switched["switch remote"] > 40);
  CHECK(switched["plan_switch remote"] == switched["switch remote"]);
  // The run may end before the first local plan.
  CHECK(switched["plan_switch local"] >= switched["switch local"] - 6);
  CHECK(switched["plan_switch local"] <= switched["switch local"]);
  const auto jumps = summary_of(half_an_hour())["switch"];
  CHECK(jumps["count"]
        == switched["plan_switch remote"] + switched["plan_switch local"]);
  CHECK(jumps["max_d_m"] < 0.05);
  CHECK(jumps["max_v_mps"] < 0.1);
  CHECK(jumps["max_a_mps2"] < 0.3);
}

TEST_CASE("the vehicles' lines add up to the summary") {
  const auto summary = summary_of(half_an_hour());
  const auto rows = rows_of(half_an_hour() / "vehicles.csv");
  REQUIRE(rows.size() == 6);
  const auto sum = [&rows](const std::string& column) {
    return mean(rows, column) * static_cast<double>(rows.size());
  };
  const auto& driving = summary["driving"];
  CHECK(sum("driven_s") == near(summary["safety"]["driven_s"], rounding));
  CHECK(sum("distance_m") == near(driving["distance_m"], rounding));
  CHECK(sum("plans") == near(summary["plans"]["count"], rounding));
  CHECK(sum("comfort_cost_m2ps3")
        == near(driving["comfort_cost_m2ps3"], rounding));
  for (const std::string extreme : {"max_jerk_mps3", "max_lateral_accel_mps2"})
    CHECK(largest(rows, extreme) == near(driving[extreme], rounding));
  CHECK(largest(rows, "max_plan_age_ms")
        == near(1000 * summary["safety"]["max_plan_age_s"].get<double>(),
                rounding));
}

TEST_CASE("a vehicle's distance is that of its track") {
  const auto tracks = rows_of(half_an_hour() / "tracks.csv");
  for (const auto& v : rows_of(half_an_hour() / "vehicles.csv")) {
    CAPTURE(v.at("station"));
    double first_m = -1, last_m = 0;
    for (const auto& r : tracks)
      if (r.at("station") == v.at("station")) {
        last_m = number(r, "s_m");
        if (first_m < 0)
          first_m = last_m;
      }
    CHECK(number(v, "distance_m") == near(last_m - first_m, 0.001));
  }
}

TEST_CASE("every vehicle offloads at least once on each of its laps") {
  const auto tracks = rows_of(half_an_hour() / "tracks.csv");
  const auto episodes =
      episodes_of(half_an_hour(), "requester", "trajectory_planning");
  for (auto station = 101; station <= 106; ++station) {
    CAPTURE(station);
    const auto name = std::to_string(station);
    const auto laps = laps_of(tracks, name);
    CHECK(laps.size() >= 7);
    for (const auto& lap : laps) {
      CAPTURE(lap.begin_s);
      CHECK(std::ranges::any_of(episodes, [&](const row& e) {
        return e.at("station") == name && e.at("first_data_s") != ""
               && number(e, "first_data_s") < lap.end_s
               && number(e, "ended_s") > lap.begin_s;
      }));
    }
  }
}

TEST_CASE("the summary is what the files say") {
  const auto folder = half_an_hour();
  const auto summary = summary_of(folder);
  CHECK(summary["seed"] == 1);
  CHECK(summary["virtual_s"] == 1800.0);
  CHECK(summary["vehicles"] == 6);
  CHECK(summary["interrupted"] == false);
  const auto cycles = rows_of(folder / "cycles.csv");
  for (const std::string kind : {"trajectory_planning", "cabin_climate"}) {
    CAPTURE(kind);
    const auto& says = summary["services"][kind];
    const auto closed = episodes_of(folder, "requester", kind);
    auto with_data = closed;
    std::erase_if(with_data,
                  [](const row& e) { return e.at("first_data_s").empty(); });
    auto running = 0;
    for (const auto& e : closed)
      CHECK(says["ended_by"].contains(e.at("reason")));
    for (const auto& [reason, count] : says["ended_by"].items()) {
      CAPTURE(reason);
      CHECK(std::ranges::count_if(
                closed, [&](const row& e) { return e.at("reason") == reason; })
            == count);
    }
    running = says["running_at_end"];
    CHECK(with_data.size() + running == says["episodes"]);
    CHECK(closed.size() - with_data.size() == says["no_data"]);
    CHECK(std::ranges::count_if(
              closed, [](const row& e) { return e.at("fallback") == "1"; })
          == says["fallbacks"]);
    CHECK(says["requests"]
          == says["accepted"].get<int>() + says["rejected"].get<int>());
    CHECK(says["accepted"]
          == says["episodes"].get<int>() + says["no_data"].get<int>());
    auto ended = with_data; // before the run did
    std::erase_if(ended,
                  [](const row& e) { return e.at("reason") == "shutdown"; });
    CHECK(ended.size() < with_data.size());
    CHECK(says["t_off_s"]["mean"] == near(mean(ended, "t_off_s"), rounding));
    CHECK(says["t_off_s"]["max"] == near(largest(ended, "t_off_s"), rounding));
    CHECK(says["offloaded_share"]
          == near(mean(with_data, "t_off_s")
                      * static_cast<double>(with_data.size()) / (6 * 1800),
                  1e-5));

    auto received = cycles;
    std::erase_if(received,
                  [&](const row& c) { return c.at("service") != kind; });
    CHECK(received.size() == says["latency_ms"]["count"]);
    CHECK(std::ranges::count_if(
              received, [](const row& c) { return c.at("used") == "1"; })
          == says["results_used"]);
    CHECK(says["latency_ms"]["mean"]
          == near(mean(received, "latency_ms"), rounding));
    CHECK(says["latency_ms"]["max"]
          == near(largest(received, "latency_ms"), rounding));
    std::erase_if(received,
                  [](const row& c) { return c.at("interarrival_ms").empty(); });
    CHECK(received.size() == says["interarrival_ms"]["count"]);
    CHECK(says["interarrival_ms"]["mean"]
          == near(mean(received, "interarrival_ms"), rounding));
  }
  for (const auto* member :
       {"requests", "episodes", "t_off_s", "latency_ms", "ended_by"})
    CHECK(summary[member]
          == summary["services"]["trajectory_planning"][member]);
}

TEST_CASE("every episode ends once on both sides") {
  for (const std::string kind : {"trajectory_planning", "cabin_climate"}) {
    std::multiset<std::string> counters[2];
    for (auto i : {0, 1})
      for (const auto& e :
           episodes_of(half_an_hour(), i ? "requester" : "provider", kind)) {
        counters[i].insert(e.at("provider_id") + " " + e.at("station") + " "
                           + e.at("counter"));
        REQUIRE(number(e, "accepted_s") <= number(e, "ended_s"));
      }
    CHECK(counters[0].size() >= 40);
    CHECK(counters[0] == counters[1]);
    for (const auto& name : counters[0])
      REQUIRE(counters[0].count(name) == 1);
  }
}

TEST_CASE("remote is who has an episode") {
  // Tracks, cycles and episodes come from different actors.
  const auto episodes =
      episodes_of(half_an_hour(), "requester", "trajectory_planning");
  auto remote = 0;
  for (const auto& r : rows_of(half_an_hour() / "tracks.csv")) {
    const auto t_s = number(r, "t_s");
    const auto offloads = std::ranges::any_of(episodes, [&](const row& e) {
      return e.at("station") == r.at("station")
             && number(e, "first_data_s") <= t_s && t_s < number(e, "ended_s");
    });
    remote += offloads;
    REQUIRE((r.at("source") == "remote") == offloads);
  }
  const double share = summary_of(half_an_hour())["offloaded_share"];
  CHECK(remote == near(share * 6 * 18000, 0.005));
}
