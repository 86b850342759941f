// What sections show is what runs had: each figure and table that could show
// something else in its place.
#include "experiments/dehler2025/area_time.hpp"
#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/dehler2025/paper_figures.hpp"
#include "experiments/dehler2025/sections.hpp"
#include "tests/experiments/made_up_runs.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace sofof::experiments::study {

using namespace made_up;
using test::contains;
using test::near;

namespace {

/// A run of the quality study with figures of its own.
measured_run quality_run(const char* codm, const std::filesystem::path& folder,
                         double braking_mps2, int emergencies) {
  auto run = driven(folder, 0, 10, "local");
  run.point.labels = {codm};
  run.figures = {{"vehicles", 1},
                 {"driving.comfort_cost_m2ps3", 10},
                 {"driving.distance_m", 1000},
                 {"driving.max_lateral_accel_mps2", 2},
                 {"driving.max_jerk_mps3", 1},
                 {"driving.min_accel_mps2", -braking_mps2},
                 {"driving.hard_brakes", 0},
                 {"safety.near_misses", 0},
                 {"safety.collisions", 0},
                 {"safety.driven_s", 100},
                 {"plans.emergency", emergencies},
                 {"switch.count", 2}};
  for (const auto* jump : {"d_m", "kappa_1pm", "v_mps", "a_mps2"})
    for (const auto* which : {"mean_", "max_"})
      run.figures[std::string{"switch."} + which + jump] = 0.001;
  return run;
}

const std::vector<std::string>& row_of(const report::table& t,
                                       std::string_view first) {
  for (const auto& row : t.rows)
    if (row.front() == first)
      return row;
  FAIL("there is no such row: ", first);
  throw 0;
}

} // namespace

TEST_CASE("who starts inside an area has not entered it") {
  const scratch dir;
  auto run = driven(dir / "run", 0, 10, "local");
  std::string tracks{tracks_header};
  for (int t = 0; t <= 100; ++t) { // 101 from inside, 102 from outside
    tracks += fmt::format("{},101,{},0,0,0,0,10,local\n", t, 10 * t);
    tracks += fmt::format("{},102,{},0,0,0,0,10,local\n", t, -500 + 10 * t);
  }
  write(dir / "run/tracks.csv", tracks);
  const measured_run* runs[] = {&run};
  CHECK(mean_time_in_area_s(runs).value() == near(51, 1e-9));
}

TEST_CASE("the latency plot shows the offloading times of its runs") {
  const scratch dir;
  const auto s = latency_plot(two_curves(dir, 50, 40, 3));
  const auto& f = the<report::figure>(s, "Offloading time against");
  REQUIRE(f.curves.size() == 2);
  CHECK(f.levels.at(0).second == "the paper's text: about 70 s");
  CHECK(f.curves[0].name == "1 vehicle");
  CHECK(f.curves[0].x == std::vector<double>{80, 150});
  CHECK(f.curves[0].y == std::vector<double>{1, 50});
  CHECK(f.curves[1].y == std::vector<double>{1, 40});
  const auto& means = the<report::table>(s, "t_off in seconds");
  CHECK(row_of(means, "1").back().starts_with("50.00 ("));
  CHECK(row_of(means, "6").back().starts_with("40.00 ("));
}

TEST_CASE(
    "latencies are drawn as shares of one, three and six vehicles' results") {
  const scratch dir;
  const auto s = delay_plot(two_latencies(dir, 10.6, 11.5));
  const auto& f = the<report::figure>(s, "How latencies are distributed");
  REQUIRE(f.curves.size() == 3);
  CHECK(f.curves[0].name == "1 vehicle");
  CHECK(f.curves[1].name == "3 vehicles");
  CHECK(f.curves[2].name == "6 vehicles");
}

TEST_CASE("where curves saturate is said of one vehicle and of six") {
  const scratch dir;
  const auto words = words_of(latency_plot(two_curves(dir, 50, 40, 3)));
  CHECK(contains(words, "One vehicle saturates at 50.0"));
  CHECK(contains(words, "six at 40.0"));
  CHECK(contains(words, "20 % below"));
}

TEST_CASE("what it costs to be in the area together is told apart") {
  const scratch dir;
  const auto s = latency_plot(two_curves(dir, 50, 40, 3));
  CHECK(std::ranges::any_of(s.blocks, [](const report::block& x) {
    const auto* text = std::get_if<report::paragraph>(&x);
    return text && text->text.find("spread over") != std::string::npos;
  }));
}

TEST_CASE("episodes of one run count as one run, however many they are") {
  // Ten runs of fifty episodes, alike within a run.
  std::vector<measured_run> runs(10);
  std::vector<const measured_run*> all;
  double t_off_s = 1;
  for (auto& run : runs) {
    run.t_off_s.assign(50, t_off_s++);
    run.ended_early = 49;
    all.push_back(&run);
  }
  const auto t_off = mean_t_off(all).value();
  CHECK(t_off.mean == near(5.5, 1e-9));
  CHECK(t_off.half_width() > 1.5); // of five hundred it were 0.25
}

TEST_CASE("early ends are counted per pass, and their seeds are named") {
  const scratch dir;
  auto e = two_curves(dir, 50, 40, 3);
  for (const auto* n : {"1", "6"}) {
    auto stay = driven(dir / n, 0, 10, "local");
    stay.point.labels = {n};
    e.in_area.push_back(stay);
  }
  // Of eight episodes of six vehicles two end early: six passes.
  e.latency_plot.back().point.seed = 17;
  e.latency_plot.back().t_off_s.assign(8, 40);
  e.latency_plot.back().ended_early = 2;
  const auto s = latency_plot(e);
  const auto& t = the<report::table>(s, "Where the curves saturate");
  CHECK(t.columns[5] == "early ends per pass");
  CHECK(row_of(t, "6")[5] == "0.33");
  CHECK(row_of(t, "6")[6] == "17");
  CHECK(row_of(t, "1")[5] == "0.00");
  CHECK(row_of(t, "1")[6] == "none");
  CHECK(row_of(t, "6")[7] == "100 % (2–100)");
}

TEST_CASE("the delay plot shows the latencies of its runs, of all limits") {
  const scratch dir;
  auto e = two_latencies(dir, 12.5, 14);
  e.latency_plot.push_back(e.latency_plot.front());
  e.latency_plot.back().point.labels[1] = "10ms";
  e.latency_plot.back().figures["latency_ms.mean"] = 13.5;
  const auto s = delay_plot(e);
  const auto& f = the<report::figure>(s, "Latency of trajectories");
  CHECK(f.curves[0].name == "mean ± standard deviation");
  CHECK(f.curves[0].y.front() == near(13, 1e-9));
  CHECK(f.curves[0].y.back() == near(14, 1e-9));
  CHECK(f.curves[1].y == std::vector<double>{10.54});
  const auto& t = the<report::table>(s, "Latency and inter-arrival");
  CHECK(row_of(t, "1")[2].starts_with("13.00 ± "));
  CHECK(row_of(t, "1")[7].starts_with("12.50 ± "));
  CHECK(row_of(t, "6")[2].starts_with("14.00 ± "));
}

TEST_CASE("latencies are those of the seeds that each point has") {
  const scratch dir;
  auto e = two_latencies(dir, 12, 14);
  for (const auto seed : {1, 2}) { // 10 ms has one seed more than 100 ms
    e.latency_plot.push_back(e.latency_plot.front());
    e.latency_plot.back().point = {{"1", "10ms"}, seed, {}};
    e.latency_plot.back().figures["latency_ms.mean"] = seed == 1 ? 13 : 99;
  }
  for (auto& run : e.latency_plot)
    if (run.point.labels[1] == "100ms")
      run.point.seed = 1;
  CHECK(latency_runs(e, "1").size() == 2);
  CHECK(figures_of(e).by_vehicles[0].latency_ms->mean == near(12.5, 1e-9));
  const auto s = delay_plot(e);
  CHECK(the<report::figure>(s, "Latency of trajectories").curves[0].y.front()
        == near(12.5, 1e-9));
}

TEST_CASE("computing costs are as sure as their runs are alike") {
  paper_runs e;
  const auto run = [](double active, double remote) {
    return recording::cpu_figures{{active, 0, 1, remote}, 1, 1, 10, 10, 0};
  };
  e.cpu_20_hz.length_s = e.cpu_100_hz.length_s = 20;
  e.cpu_20_hz.v2x_at_most = 0.127;
  e.cpu_100_hz.v2x_at_most = 0.213;
  e.cpu_20_hz.runs = {run(10, 1), run(20, 1), run(30, 1)};
  e.cpu_20_hz.figures = recording::together(e.cpu_20_hz.runs);
  const auto f = figures_of(e);
  CHECK(f.v2x_at_most == 0.213); // of the worse rate
  CHECK_FALSE(f.cpu_100_hz);
  REQUIRE(f.cpu_20_hz);
  CHECK(f.cpu_20_hz->active.mean == near(20, 1e-9));
  CHECK(f.cpu_20_hz->active.half_width() > 5);
  CHECK(f.cpu_20_hz->requester_remote.half_width() < 1e-9);
  CHECK(f.cpu_20_hz->break_even->mean == near(5, 1e-9)); // 1 of 20
  // 10, 5 and 3.33 %: half of the interval is 4.303 · 3.727 / √3.
  CHECK(f.cpu_20_hz->break_even->high == near(5 + 9.258, 1e-3));
  CHECK(f.cpu_20_hz->break_even->low == 0);
  e.cpu_20_hz.runs.push_back(run(10, 12)); // never pays there
  CHECK(std::isinf(figures_of(e).cpu_20_hz->break_even->high));
}

TEST_CASE("results above 50 ms are those above 50 ms") {
  const scratch dir;
  const auto e = two_latencies(dir, 12.5, 14); // one of four at 60 ms
  const auto s = delay_plot(e);
  const auto& t = the<report::table>(s, "Latency and inter-arrival");
  CHECK(t.columns[4] == "above 50 ms");
  CHECK(row_of(t, "1")[4] == "25.0000 %");
  CHECK(figures_of(e).by_vehicles.front().late_share == 0.25);
}

TEST_CASE("real drives that end early are counted") {
  const scratch dir;
  auto e = two_latencies(dir, 10, 10);
  write(dir / "episodes.csv", episodes_header);
  for (const auto seed : {1, 2})
    for (int drive = 0; drive < 2; ++drive) {
      e.real_world.push_back(e.delay_plot.front());
      e.real_world.back().point = {{std::to_string(drive)}, seed, {}};
      e.real_world.back().ended_early = seed == 2 ? 2 : 0;
    }
  e.latency_plot.clear();
  const auto f = figures_of(e);
  CHECK(f.drives == 4);
  CHECK(f.drives_ended_early == 2);
  const auto s = real_world(e);
  const auto& t = the<report::table>(s, "The real drives");
  CHECK(row_of(t, "drives of 2 that ended offloading early, mean (exact 95 % "
                  "interval)")[1]
        == "1.00 (0.14–1.86)");
  CHECK(row_of(t, "the same, least and most of all seeds")[1] == "0 and 2");
}

TEST_CASE("the quality section holds local against offloaded driving") {
  const scratch dir;
  paper_runs e;
  e.quality.push_back(quality_run("location", dir / "location", 3, 7));
  e.quality.push_back(quality_run("never", dir / "never", 2, 5));
  const auto s = quality(e);
  const auto& t = the<report::table>(s, "Driving, all seeds");
  CHECK(t.columns == std::vector<std::string>{"figure", "offloaded", "local"});
  CHECK(row_of(t, "hardest braking, m/s²")[1] == "3.00");
  CHECK(row_of(t, "hardest braking, m/s²")[2] == "2.00");
  CHECK(row_of(t, "emergency plans")[1] == "7");
  CHECK(row_of(t, "emergency plans")[2] == "5");
}

} // namespace sofof::experiments::study
