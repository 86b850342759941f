// Sections of the paper's evaluation, from runs that are made up.
#include "base/input_error.hpp"
#include "experiments/dehler2025/area_time.hpp"
#include "experiments/dehler2025/describe_sweep.hpp"
#include "experiments/dehler2025/deviation.hpp"
#include "experiments/dehler2025/sections.hpp"
#include "tests/experiments/made_up_runs.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

namespace sofof::experiments::study {

using namespace made_up;
using test::contains;
using test::near;

namespace {

/// A folder of a sweep over two gaps.
/// @param seeds  Of each gap.
void make_sweep(const std::filesystem::path& folder, int seeds = 2) {
  std::string table = "point,gap,seed,status,run\n";
  int number = 0;
  for (const auto* gap : {"60ms", "1s"})
    for (int seed = 1; seed <= seeds; ++seed) {
      ++number;
      const auto run = fmt::format("a{}", number);
      table += fmt::format("{},{},{},ok,{}\n", number, gap, seed, run);
      write(folder / "runs" / run / "summary.json",
            fmt::format(R"({{"interrupted":false,"vehicles":2,"virtual_s":100,
                "safety":{{"driven_s":{0}00}},
                "offloaded_share":0.{0},"fallbacks":{0},
                "latency_ms":{{"count":{0}0,"mean":{0},"std":1}}}})",
                        number));
      write(folder / "runs" / run / "episodes.csv",
            fmt::format("{}requester,101,mec,1,trajectory_planning,1,1,2,12,{},"
                        "left_area,0\n",
                        episodes_header, 10 * number));
    }
  write(folder / "gaps.csv", table);
}

} // namespace

TEST_CASE("the time in an area is from the entry to the exit") {
  const scratch dir;
  const auto run = driven(dir / "run", 0, 10, "local");
  const measured_run* runs[] = {&run};
  // In from x = -200 on, out after x = 300, a line every 10 m.
  CHECK(mean_time_in_area_s(runs).value() == near(51, 1e-9));
  CHECK_FALSE(mean_time_in_area_s({}));
}

TEST_CASE("two drives are compared at the same places, where one was remote") {
  const scratch dir;
  const auto local = driven(dir / "local", 0.5, 10, "local");
  const auto remote = driven(dir / "remote", 0.2, 12, "remote");
  const auto d = deviation_between(remote, local);
  CHECK(d.path_rms_m == near(0.3, 1e-9));
  CHECK(d.path_max_m == near(0.3, 1e-9));
  CHECK(d.speed_rms_mps == near(2, 1e-9));
  CHECK(d.samples > 90);
  CHECK(deviation_between(local, remote).samples == 0);
}

TEST_CASE("computing time is shown beside the paper's, which does not add up") {
  paper_runs e;
  e.cpu_20_hz.figures = {{0.2, 0, 0.02, 0.12}, 0.07, 6, 60, 40, 0.001};
  e.cpu_20_hz.speed_mps = 10;
  e.cpu_100_hz.figures = {{0.2, 0, 0.02, 0.3}, 0.07, 6, 60, 40, 0.001};
  e.cpu_100_hz.speed_mps = 10;
  e.cpu_20_hz.length_s = 20;
  e.cpu_20_hz.runs.resize(3);
  e.cpu_20_hz.v2x_at_most = 0.05;
  const auto s = cpu_cost(e);
  CHECK(contains(words_of(s), "3 wall-clock runs of 20 s each"));
  CHECK(contains(words_of(s), "At 20 Hz offloading pays from 20.00 %"));
  CHECK(contains(words_of(s), "At 100 Hz offloading does not pay"));
  const auto& shares = the<report::table>(s, "Computing time");
  REQUIRE(shares.rows.size() == 6);
  CHECK(shares.rows[0].back() == "8.73 %");
  CHECK(shares.rows[1].back() == "20.00 %");
  CHECK(shares.rows[2].back() == "2.97 %");
  CHECK(shares.rows[3].back() == "never");
  CHECK(shares.note.find("7.93 % and 6.15 %") != std::string::npos);
  const auto& balance = the<report::table>(s, "With and without");
  CHECK(balance.rows[0]
        == std::vector<std::string>{"20 Hz", "6", "40.00 %", "0.200", "0.180",
                                    "0.001", "0.050", "70.00 %"});
  const auto& energy = the<report::table>(s, "What that is in energy");
  CHECK(energy.rows[0][1] == "0.552"); // 0.2 % of 2.76 W for 100 s
}

TEST_CASE("a fit is said to add little, and latency to grow, if they do") {
  const scratch dir;
  const auto as_was = words_of(delay_plot(two_latencies(dir, 10.6, 11.5)));
  CHECK(contains(as_was, "10.54 ± 9.83 ms for one"));
  CHECK(contains(as_was, "the way of the data adds little of its own. From one "
                         "vehicle to six the mean changes by +8.5 %, the "
                         "deviation by +0.0 %."));
  const auto other = words_of(delay_plot(two_latencies(dir, 15, 14)));
  CHECK(contains(other, "ours differ by 42 % and 0 %"));
  CHECK(contains(other, "the mean changes by -6.7 %"));
}

TEST_CASE("drives are told with their seeds, and a tail if there is one") {
  const scratch dir;
  paper_runs e = two_latencies(dir, 10, 10);
  write(dir / "episodes.csv", episodes_header);
  e.real_world.push_back(e.delay_plot.front());
  e.real_world.front().point.seed = 1;
  const auto words = words_of(real_world(e));
  CAPTURE(words);
  CHECK(contains(
      words,
      "are fitted to the paper's, for one seed. The paper does not name"));
  CHECK(contains(words, "do not tell: one result in 4 takes longer than 50 ms "
                        "here, and a drive has 4. The channel's least delay"));
}

TEST_CASE("a folder of sweeps is shown with curves over what was varied") {
  const scratch dir;
  make_sweep(dir.path());
  write(dir / "other.csv", "not,of,a,sweep\n");
  CHECK(is_sweep_folder(dir.path()));
  CHECK_FALSE(is_sweep_folder(dir / "runs"));
  const auto all = describe_sweeps(dir.path(), "1");
  CHECK(all.title == "gaps");
  REQUIRE(all.sections.size() == 1);
  const auto& f = the<report::figure>(all.sections[0], "Offloading time");
  CHECK(f.x_label == "gap, ms");
  REQUIRE(f.curves.size() == 1);
  CHECK(f.curves[0].x == std::vector<double>{60, 1000});
  CHECK(f.curves[0].y == std::vector<double>{15, 35});
  const auto& latency = the<report::figure>(all.sections[0], "Latency");
  CHECK(latency.curves[0].y[0] == near(50.0 / 30, 1e-9)); // of all results
  const auto& share = the<report::figure>(all.sections[0], "Offloaded share");
  CHECK(share.curves[0].y[0] == near(50.0 / 300, 1e-9)); // of all driving
  const auto& back = the<report::figure>(all.sections[0], "Fallbacks");
  CHECK(back.curves[0].y[0] == near(3 / (300.0 / 3600), 1e-9));
  const auto& points = the<report::table>(all.sections[0], "All points");
  REQUIRE(points.rows.size() == 2);
  CHECK(points.rows[0][0] == "60ms");
  CHECK(points.rows[1][2] == "35.000");
  for (const auto& said : {f.caption, points.note})
    CHECK(said.find("the end of a run cuts off are left out") != said.npos);
}

TEST_CASE("intervals over runs are drawn where a point has five or more") {
  const auto band_of = [](int seeds) {
    const scratch dir;
    make_sweep(dir.path(), seeds);
    const auto all = describe_sweeps(dir.path(), "1");
    const auto& c =
        the<report::figure>(all.sections[0], "Offloading time").curves[0];
    return std::pair{c.low[0], c.high[0]};
  };
  CHECK(std::isnan(band_of(4).first));
  CHECK(std::isnan(band_of(4).second));
  const auto [low, high] = band_of(5); // of 10 to 50 s
  CHECK(low < 21);
  CHECK(high > 39);
}

TEST_CASE("a run without a value does not count for an interval") {
  const scratch dir;
  make_sweep(dir.path(), 5);
  write(dir / "runs/a1/episodes.csv", episodes_header);
  const auto all = describe_sweeps(dir.path(), "1");
  const auto low_of = [&all](const char* title) {
    return the<report::figure>(all.sections[0], title).curves[0].low[0];
  };
  CHECK(std::isnan(low_of("Offloading time")));
  CHECK(std::isfinite(low_of("Latency")));
}

TEST_CASE("a sweep's folder without a table, or without a run, is refused") {
  const scratch dir;
  make_sweep(dir.path());
  std::filesystem::remove_all(dir / "runs/a3");
  CHECK_THROWS_WITH_AS(describe_sweeps(dir.path(), "1"),
                       doctest::Contains("has not come to its end"),
                       input_error);
  write(dir / "gaps.csv", "point,gap,seed,status,run\n1,60ms,1,ok,../x\n");
  CHECK_THROWS_WITH_AS(describe_sweeps(dir.path(), "1"),
                       doctest::Contains("gaps.csv:2"), input_error);
  std::filesystem::remove(dir / "gaps.csv");
  CHECK_THROWS_WITH_AS(describe_sweeps(dir.path(), "1"),
                       doctest::Contains("no sweep has come to its end"),
                       input_error);
}

} // namespace sofof::experiments::study
