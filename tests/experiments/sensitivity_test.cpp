// One vehicle and its latencies, and the sections that vary what is chosen.
#include "base/input_error.hpp"
#include "experiments/dehler2025/latency_model.hpp"
#include "experiments/dehler2025/sections.hpp"
#include "tests/experiments/made_up_runs.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace sofof::experiments::study {

using namespace made_up;
using test::contains;
using test::near;

TEST_CASE("a latency's tail may end elsewhere, its mean and deviation stay") {
  for (const double longest_ms : {45, 52, 60, 500}) {
    CAPTURE(longest_ms);
    const bounded_latency law{10.54, 9.83, longest_ms};
    double sum = 0, squares = 0;
    constexpr int steps = 20'000;
    for (int i = 0; i < steps; ++i) {
      const auto x = law.quantile_ms((i + 0.5) / steps);
      sum += x;
      squares += x * x;
    }
    const auto mean = sum / steps;
    CHECK(mean == near(10.54, 1e-3));
    CHECK(std::sqrt(squares / steps - mean * mean) == near(9.83, 2e-3));
    CHECK(law.quantile_ms(1 - law.share_above(30)) == near(30, 1e-3));
    CHECK(law.share_above(longest_ms) == 0);
  }
}

TEST_CASE("a vehicle whose latencies end at 45 ms stays offloaded at 100 ms") {
  const bounded_latency law{10.54, 9.83, 45};
  pass_model pass;
  pass.passes = 50;
  CHECK(mean_t_off_s(law, pass) == near(70, 1e-3));
  pass.max_interarrival_ms = 80;
  const auto apart = mean_t_off_s(law, pass);
  CHECK(apart > 2);
  CHECK(apart < 3);
  pass.correlation = 0.99;
  CHECK(mean_t_off_s(law, pass) > 60);
}

TEST_CASE("late results end offloadings whatever gaps are allowed") {
  const bounded_latency law{10.54, 9.83, 60};
  pass_model pass;
  pass.passes = 50;
  pass.max_interarrival_ms = 1000;
  const auto t_off = mean_t_off_s(law, pass);
  // One of 1050 results is late: every 52 s, and passes end after 70 s.
  CHECK(t_off > 20);
  CHECK(t_off < 40);
}

TEST_CASE("how many drives end early hangs on the least delay") {
  double before = 0;
  for (const double least_ms : {2, 3, 4, 5, 6, 7}) {
    const auto share = share_of_drives_with_a_late_result(least_ms, 50, 2708);
    CHECK(share > before);
    before = share;
  }
  CHECK(15 * share_of_drives_with_a_late_result(2, 50, 2708) < 0.1);
  CHECK(15 * share_of_drives_with_a_late_result(7, 50, 2708) > 8);
  CHECK(share_of_drives_with_a_late_result(5, 50, 0) == 0);
}

TEST_CASE("refusals are shares of the decisions of each side") {
  paper_runs e;
  for (const auto* requirements : {"none", "strict"})
    for (const auto seed : {1, 2}) {
      auto& run = e.refusals.emplace_back();
      run.point = {{requirements}, seed, {}};
      const auto strict = std::string_view{requirements} == "strict";
      run.figures = {{"offers", 100},
                     {"requests", strict ? 72.0 : 90.0},
                     {"rejected", strict ? 18.0 : 0.0},
                     {"offloaded_share", strict ? 0.2 : 0.4},
                     {"safety.driven_s", 1080}};
      run.t_off_s = {2, 3};
      run.ended_early = 2;
    }
  const auto s = refusals(e);
  const auto& t = the<report::table>(s, "Decisions");
  REQUIRE(t.rows.size() == 2);
  CHECK(t.rows[0][3] == "–"); // it is what the others are held against
  CHECK(t.rows[0][5] == "0.0 %");
  CHECK(t.rows[1]
        == std::vector<std::string>{"strict", "200", "180", "20.0 %", "144",
                                    "25.0 %", "108", "2.50 (2.50–2.50)",
                                    "20.0 %"});
  CHECK(contains(words_of(s), "the offloadings go from 180 to 108"));
}

TEST_CASE("without the line that requires nothing, one sentence says so") {
  paper_runs e;
  auto& run = e.refusals.emplace_back();
  run.point = {{"strict"}, 1, {}};
  run.figures = {{"offers", 100},
                 {"requests", 72},
                 {"rejected", 18},
                 {"offloaded_share", 0.2},
                 {"safety.driven_s", 1080}};
  CHECK_THROWS_WITH_AS(refusals(e), doctest::Contains("no line \"none\""),
                       input_error);
}

// One section, as its pictures take seconds: each sum needs runs of its own.
TEST_CASE("what is chosen is varied beside what is measured") {
  const scratch dir;
  auto e = two_curves(dir, 50, 40, 3);
  for (const auto results : {20'000, 30'000})
    e.real_world.emplace_back().figures = {{"latency_ms.count", results}};
  for (const auto* n : {"1", "6"})
    for (auto* runs : {&e.correlated, &e.loaded_host}) {
      auto& run = runs->emplace_back();
      run.point = {{n, "150ms"}, 1, {}};
      run.figures = {{"latency_ms.count", 100},
                     {"latency_ms.mean", n[0] == '1' ? 11 : 15},
                     {"latency_ms.std", 9}};
      run.t_off_s = {runs == &e.correlated ? 70.0 : n[0] == '1' ? 60.0 : 30.0};
    }
  for (const auto* host : {"1 worker", "2 workers"}) {
    auto& run = e.host.emplace_back();
    run.point = {{"6", host}, 1, {}};
    run.figures = {{"latency_ms.count", 100},
                   {"latency_ms.mean", 11},
                   {"latency_ms.std", 9},
                   {"offloaded_share", 0.5},
                   {"safety.driven_s", 1080}};
    run.t_off_s = {host[0] == '1' ? 50.0 : 70.0};
  }
  const auto s = sensitivity(e);

  // The least delay's drives have as many results as the real ones.
  const auto& least = the<report::figure>(s, "The least delay");
  CHECK(contains(least.caption, "25000"));
  CHECK(least.curves[0].y[3]
        == near(15 * share_of_drives_with_a_late_result(5, 50, 25'000), 1e-9));

  // A loaded host and correlated latencies are drawn beside the plot.
  const auto& one_host = the<report::figure>(s, "One host");
  REQUIRE(one_host.curves.size() == 4);
  CHECK(one_host.curves[0].y == std::vector<double>{60});
  CHECK(one_host.curves[1].y == std::vector<double>{30});
  CHECK(one_host.curves[2].dashed);
  CHECK(one_host.curves[2].y.back() == 50);
  CHECK(contains(one_host.caption, "15.00 ± 9.00 ms with six"));
  const auto& level = the<report::figure>(s, "Latencies that depend on the one "
                                             "before, simulated");
  CHECK(level.curves[0].y == std::vector<double>{70});
  CHECK(contains(level.caption, "11.00 ± 9.00 ms for one"));

  // Hosts are shown with their runs.
  const auto& hosts = the<report::table>(s, "The host");
  REQUIRE(hosts.rows.size() == 2);
  CHECK(hosts.rows[0][0] == "1 worker");
  CHECK(hosts.rows[0][2].starts_with("50.0 ("));
  CHECK(hosts.rows[1][2].starts_with("70.0 ("));
  CHECK(hosts.rows[0][4] == "11.00 ± 9.00");
}

} // namespace sofof::experiments::study
