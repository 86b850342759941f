// What a run is judged by.
#include "base/input_error.hpp"
#include "experiments/benchmark/criteria.hpp"
#include "scenario/load.hpp"
#include "tests/support/bench_town.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

namespace sofof::experiments::bench {

using namespace scenario;
using namespace std::string_literals;
using test::near;

namespace {

/// Twenty vehicles in six minutes, none there all the time, that drive one hour
/// together.
study::measured_run one_hour() {
  study::measured_run run{{{"mine"}, 3, {}}, "folder", {}, {}, 0};
  run.figures = {{"vehicles", 20},
                 {"virtual_s", 360},
                 {"offers", 100},
                 {"requests", 40},
                 {"rejected", 10},
                 {"fallbacks", 7},
                 {"ping_pongs", 4},
                 {"hand_overs", 2},
                 {"offloaded_share", 0.5},
                 {"fairness", 0.8},
                 {"ended_by.qos_latency", 3},
                 {"ended_by.qos_input_age", 0},
                 {"ended_by.qos_gap", 2},
                 {"latency_ms.mean", 20},
                 {"latency_ms.p50", 18},
                 {"latency_ms.p95", 30},
                 {"latency_ms.p99", 40},
                 {"safety.driven_s", 3600},
                 {"safety.without_fresh_plan_s", 0},
                 {"safety.off_road_s", 0},
                 {"safety.collisions", 0},
                 {"services.trajectory_planning.cycles.on_board", 18000},
                 {"services.trajectory_planning.cycles.offloaded", 18000},
                 {"services.trajectory_planning.latency_ms.mean", 20},
                 {"services.trajectory_planning.ended_by.qos_latency", 3},
                 {"services.trajectory_planning.requests", 40},
                 {"services.trajectory_planning.ended_by.qos_gap", 2},
                 {"services.trajectory_planning.ended_by.left_area", 25},
                 {"services.trajectory_planning.served.ended_by.left_area", 28},
                 {"services.trajectory_planning.served.count", 30},
                 {"services.trajectory_planning.served.time_s.mean", 60}};
  run.served_s = {{{1, "trajectory_planning"}, 10 * 60},
                  {{2, "trajectory_planning"}, 20 * 60}};
  return run;
}

baseline usual() {
  const provider_capacity each{1, {{"trajectory_planning", 0.08}}};
  return {{{"trajectory_planning", 0.05, 0.1, 0.01}}, {each, each}};
}

double value(const judged_run& run, std::string_view name) {
  const auto found = run.values.find(name);
  REQUIRE(found != run.values.end());
  return found->second;
}

judged_run scored(const char* entrant, const char* scenario, std::int64_t seed,
                  double score) {
  return {entrant, scenario, seed, true, {{score_name, score}}};
}

} // namespace

TEST_CASE("rates are per hour that a vehicle drives, shares in percent") {
  const auto run = judge(one_hour(), usual());
  CHECK(run.entrant == "mine");
  CHECK(run.seed == 3);
  CHECK(run.safe);
  CHECK(value(run, "offloaded_percent") == near(50, 1e-9));
  CHECK(value(run, "violations_per_h") == near(5, 1e-9));
  CHECK(value(run, "fallbacks_per_h") == near(7, 1e-9));
  CHECK(value(run, "ping_pongs_per_h") == near(4, 1e-9));
  CHECK(value(run, "hand_overs_per_h") == near(2, 1e-9));
  CHECK(value(run, "rejected_percent") == near(25, 1e-9));
  CHECK(value(run, "latency_p95_ms") == 30);
  CHECK(value(run, "fairness") == 0.8);
}

TEST_CASE("a provider is used as much as what it served takes of its time") {
  // 30 · 60 s of 8 % of the workers, of two providers for 360 s.
  CHECK(value(judge(one_hour(), usual()), "utilisation_percent")
        == near(100 * 30 * 60 * 0.08 / (2 * 360), 1e-9));
}

TEST_CASE("what a provider served takes its own computer's time") {
  // 600 s of 8 % of one worker here, 1200 s of 2 % of each of four there.
  auto by = usual();
  by.providers[1] = {4, {{"trajectory_planning", 0.02}}};
  CHECK(value(judge(one_hour(), by), "utilisation_percent")
        == near(100 * (600 * 0.08 + 1200 * 4 * 0.02) / (5 * 360), 1e-9));
}

TEST_CASE("a vehicle's planner takes its run times of a core, when on board") {
  CHECK(value(judge(one_hour(), usual()), "vehicle_cpu_percent")
        == near(100 * 0.5 * 0.01 / 0.1, 1e-9));
}

TEST_CASE("signalling is offers, requests, answers and ends") {
  CHECK(value(judge(one_hour(), usual()), "messages_per_s")
        == near((100 + 2 * 40 + 30) / 360., 1e-9));
}

TEST_CASE("the score is the mean cost of a cycle: time, energy, violations") {
  const auto time = (0.5 * 0.020 + 0.5 * 0.010) / 0.05;
  const auto violated = 5 / 36000.;
  auto run = one_hour();
  CHECK(value(judge(run, usual()), score_name)
        == near(0.3 * time + 0.3 + violated, 1e-12));
  run.figures["energy.saved_share"] = 0.4;
  run.figures["energy.per_km_j"] = 120;
  run.figures["energy.j"] = 60;
  run.figures["energy.local_j"] = 50;
  run.figures["energy.offloading_j"] = 10;
  run.figures["energy.server_j"] = 30;
  const auto judged = judge(run, usual());
  CHECK(value(judged, score_name)
        == near(0.3 * time + 0.3 * 0.6 + violated, 1e-12));
  CHECK(value(judged, "energy_saved_percent") == near(40, 1e-9));
  CHECK(value(judged, "energy_j_per_km") == 120);
  CHECK(value(judged, "energy_on_board_j_per_km") == near(100, 1e-9));
  CHECK(value(judged, "energy_offloading_j_per_km") == near(20, 1e-9));
  CHECK(value(judged, "energy_server_j_per_km") == near(60, 1e-9));
}

TEST_CASE("a cycle of every service counts in the score, and on board") {
  auto by = usual();
  by.services.push_back({"cabin_climate", 2, 1, 0.04});
  auto run = one_hour();
  run.figures["services.cabin_climate.cycles.on_board"] = 2700;
  run.figures["services.cabin_climate.cycles.offloaded"] = 900;
  run.figures["services.cabin_climate.latency_ms.mean"] = 100;
  run.figures["services.cabin_climate.ended_by.qos_gap"] = 6;
  // Ten cycles of planning for one of the cabin.
  const auto planning = (0.5 * 0.020 + 0.5 * 0.010) / 0.05;
  const auto cabin = (0.25 * 0.1 + 0.75 * 0.04) / 2;
  const auto violated = (5 + 6) / (11 * 3600.);
  CHECK(value(judge(run, by), score_name)
        == near(0.3 * (10 * planning + cabin) / 11 + 0.3 + violated, 1e-12));
  CHECK(value(judge(run, by), "vehicle_cpu_percent")
        == near(100 * (0.5 * 0.01 / 0.1 + 0.75 * 0.04), 1e-9));
}

TEST_CASE("who never offloads has the cost of planning on board") {
  auto run = one_hour();
  for (const auto* name : {"latency_ms.mean", "latency_ms.p50",
                           "latency_ms.p95", "latency_ms.p99", "fairness",
                           "services.trajectory_planning.served."
                           "time_s.mean"})
    run.figures.erase(name);
  run.served_s.clear();
  for (const auto* name :
       {"offloaded_share", "requests", "rejected", "ended_by.qos_latency",
        "ended_by.qos_input_age", "ended_by.qos_gap",
        "services.trajectory_planning.cycles.offloaded",
        "services.trajectory_planning.ended_by.qos_latency",
        "services.trajectory_planning.ended_by.qos_gap"})
    run.figures[name] = 0;
  const auto judged = judge(run, usual());
  CHECK(value(judged, score_name) == near(0.3 * 0.01 / 0.05 + 0.3, 1e-12));
  CHECK(value(judged, "utilisation_percent") == 0);
  for (const auto* name :
       {"latency_mean_ms", "fairness", "rejected_percent", "energy_j_per_km"})
    CHECK_FALSE(judged.values.contains(name));
}

TEST_CASE(
    "one second without a fresh plan, off the road or a touch is unsafe") {
  for (const auto* name : {"safety.without_fresh_plan_s", "safety.off_road_s",
                           "safety.collisions"}) {
    auto run = one_hour();
    run.figures[name] = 1;
    CHECK_FALSE(judge(run, usual()).safe);
  }
}

TEST_CASE("a summary without what every run writes is refused") {
  auto run = one_hour();
  run.figures.erase("ping_pongs");
  CHECK_THROWS_WITH_AS(judge(run, usual()),
                       "folder: its summary has no figure ping_pongs.",
                       input_error);
}

TEST_CASE("regret is against the oracle in the same scenario, same seed") {
  std::vector<judged_run> runs{
      scored("mine", "a", 1, 0.3),  scored("oracle", "a", 1, 0.2),
      scored("mine", "a", 2, 0.3),  scored("oracle", "b", 1, 0.1),
      scored("mine", "b", 1, 0.11), scored("oracle", "a", 2, 0.3)};
  compare_scores(runs);
  CHECK(value(runs[0], regret_name) == near(50, 1e-9));
  CHECK(value(runs[1], regret_name) == 0);
  CHECK(value(runs[2], regret_name) == 0);
  CHECK(value(runs[4], regret_name) == near(10, 1e-9));
  std::vector<judged_run> alone{scored("mine", "a", 1, 0.3)};
  compare_scores(alone);
  CHECK_FALSE(alone[0].values.contains(regret_name));
  CHECK_FALSE(alone[0].values.contains(than_location_name));
}

TEST_CASE("who is better than location is so on the same noise") {
  std::vector<judged_run> runs{
      scored("mine", "a", 1, 0.3), scored("location", "a", 1, 0.4),
      scored("mine", "a", 2, 0.4), scored("location", "a", 2, 0.5)};
  compare_scores(runs);
  CHECK(value(runs[0], than_location_name) == near(-25, 1e-9));
  CHECK(value(runs[1], than_location_name) == 0);
  CHECK(value(runs[2], than_location_name) == near(-20, 1e-9));
}

TEST_CASE("every figure of a run is of a criterion, and each has one name") {
  auto run = one_hour();
  for (const auto* name :
       {"saved_share", "per_km_j", "j", "local_j", "offloading_j", "server_j"})
    run.figures["energy."s + name] = 0.5;
  for (const auto* name : {"driving.hard_brakes", "traffic.stops",
                           "traffic.delay_s.mean", "traffic.delay_s.p95"})
    run.figures[name] = 1;
  const auto all = criteria();
  for (const auto& [name, x] : judge(run, usual()).values) {
    CAPTURE(name);
    CHECK(std::ranges::count(all, name, &criterion::name) == 1);
  }
  // Regret needs an oracle, and comparing needs location.
  CHECK(judge(run, usual()).values.size() == all.size() - 2);
}

TEST_CASE("a scenario tells limits, periods and what a service takes") {
  const auto s = parse_scenario(test::bench_town, "town.toml");
  const auto by = baseline_of(s);
  REQUIRE(!by.services.empty());
  const auto& planning = by.services.front();
  CHECK(planning.name == "trajectory_planning");
  CHECK(planning.limit_s == near(0.05, 1e-12));
  CHECK(planning.period_s == near(0.1, 1e-12));
  CHECK(planning.local_s > 0);
  REQUIRE(by.providers.size() == 1);
  CHECK(by.providers[0].utilisation_by.at("trajectory_planning")
        == near(0.08, 1e-9));
}

TEST_CASE("each provider computes by its own table") {
  const auto s = parse_scenario(R"([street_grid]
columns = 3
rows = 2
[[fleet]]
count = 1
routes = ["block *"]
[[provider]]
name = "near"
position_m = [100.0, 50.0]
compute = { model = "ideal", more_computing = "8ms" }
[[provider]]
name = "far"
position_m = [100.0, 50.0]
network = { profile = "ideal" }
compute = { more_computing = "2ms", workers = 4 }
[compute]
more_computing = "50ms"
[[service]]
name = "trajectory_planning"
planner = "lane_follow"
period = "100ms"
max_interarrival = "150ms"
)",
                                "two.toml");
  const auto by = baseline_of(s);
  REQUIRE(by.providers.size() == 2);
  const auto share = [&by](std::size_t place) {
    return by.providers[place].utilisation_by.at("trajectory_planning");
  };
  CHECK(share(0) == near(0.08, 1e-9));
  CHECK(by.providers[1].workers == 4);
  CHECK(share(1) == near(0.02 / 4, 1e-9));
}

} // namespace sofof::experiments::bench
