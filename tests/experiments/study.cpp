// What a study reads from runs, and how it pools them.
#include "experiments/dehler2025/histogram.hpp"
#include "experiments/dehler2025/measured_run.hpp"
#include "experiments/report/markdown.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string_view>

namespace sofof::experiments::study {

using test::scratch;
using test::write_text;

namespace {

constexpr std::string_view summary = R"({
  "interrupted": false, "seed": 3,
  "latency_ms": {"count": 3, "mean": 2.0, "std": 1.0, "p99": null}})";

constexpr std::string_view episodes =
    "side,station,provider,provider_id,service,counter,accepted_s,"
    "first_data_s,ended_s,t_off_s,reason,fallback\n"
    "requester,101,mec,1,trajectory_planning,1,1,2,12,10,left_area,0\n"
    "requester,101,mec,1,trajectory_planning,2,20,21,24,3,qos_latency,1\n"
    "requester,101,mec,1,trajectory_planning,3,30,31,99,68,shutdown,0\n"
    "requester,101,mec,1,trajectory_planning,4,40,,41,,no_data,0\n"
    "requester,101,mec,1,cabin_climate,1,1,2,9,7,left_area,0\n"
    "provider,101,mec,1,trajectory_planning,1,1,,12,,left_area,0\n";

} // namespace

TEST_CASE("episodes that the run's end cut off, or others', do not count") {
  const scratch dir;
  write_text(dir / "summary.json", summary);
  write_text(dir / "episodes.csv", episodes);
  const auto run = read_run({{"1"}, 3, {}}, dir.path());
  CHECK(run.t_off_s == std::vector<double>{10, 3});
  CHECK(run.ended_early == 1);
  CHECK(run.ended_late == 1);
  CHECK(run.served_s.size() == 1);
  CHECK(run.served_s.at({1, "trajectory_planning"}) == 11);
  CHECK(run.figure("latency_ms.mean") == 2);
  CHECK_FALSE(run.figures.contains("latency_ms.p99"));
}

TEST_CASE("spreads of several runs are those of all values together") {
  const double first[] = {1, 2, 3}, second[] = {10, 20, 30, 40};
  const auto run_of = [](std::span<const double> values) {
    double sum = 0, squares = 0;
    for (const auto x : values)
      sum += x;
    const auto n = static_cast<double>(values.size());
    for (const auto x : values)
      squares += (x - sum / n) * (x - sum / n);
    measured_run run;
    run.figures = {{"x.count", n},
                   {"x.mean", sum / n},
                   {"x.std", std::sqrt(squares / (n - 1))}};
    return run;
  };
  const auto a = run_of(first), b = run_of(second);
  const measured_run* both[] = {&a, &b};
  const auto all = pooled(both, "x");
  CHECK(all.count == 7);
  CHECK(all.mean == doctest::Approx(106.0 / 7));
  CHECK(all.deviation == doctest::Approx(15.3235).epsilon(1e-5));
}

TEST_CASE("histograms of runs add up") {
  const scratch dir;
  write_text(dir / "distributions.csv",
             "service,figure,up_to_ms,count\n"
             "trajectory_planning,latency,0.100,3\n"
             "trajectory_planning,latency,60.000,1\n"
             "trajectory_planning,interarrival,50.000,9\n"
             "cabin_climate,latency,0.100,100\n");
  auto all = read_histogram(dir.path(), planning, "latency");
  CHECK(all.count() == 4);
  CHECK(all.share_above(50) == 0.25);
  all.add(all);
  CHECK(all.count() == 8);
  const auto curve = all.cumulative("both");
  CHECK(curve.x == std::vector<double>{0.1, 60});
  CHECK(curve.y == std::vector<double>{0.75, 1});
}

TEST_CASE("a report as text has tables, and figures with few points as such") {
  report::document d{"Title", "Sub", {}};
  report::figure f;
  f.title = "Few";
  f.x_label = "x";
  f.y_label = "y";
  f.curves.push_back({"one", {1, 2}, {0.5, NAN}, {}, {}});
  f.curves.push_back({"two", {2}, {3}, {}, {}});
  f.marks.emplace_back(1.5, "a limit");
  f.levels.emplace_back(70, "theirs");
  d.sections.push_back(
      {"Section",
       {report::paragraph{"Words."},
        report::table{"T", {"a", "b|c"}, {{"1", "2"}}, "Note."}, f,
        report::scatter{"Plane", "x", "y", {{"dot", 1, 2.5}}, {}, "Said."}}});
  CHECK(report::markdown(d)
        == "# Title\nSub\n\n## Section\n\nWords.\n\n**T**\n\n| a | b\\|c |\n"
           "| --- | --- |\n| 1 | 2 |\n\nNote.\n\n**Few (y)**\n\n"
           "| x | one | two |\n| --- | --- | --- |\n| 1 | 0.5 |  |\n"
           "| 2 |  | 3 |\n\nUpright line at 1.5: a limit. Level line at 70: "
           "theirs.\n\n"
           "**Plane**\n\n|  | x | y |\n"
           "| --- | --- | --- |\n| dot | 1 | 2.5 |\n\nSaid.\n");
}

} // namespace sofof::experiments::study
