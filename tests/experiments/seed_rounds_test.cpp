// More seeds where few leave a point uncertain, and nowhere else.
#include "experiments/dehler2025/seed_rounds.hpp"

#include "experiments/dehler2025/effort.hpp"
#include "experiments/dehler2025/sweep_results.hpp"
#include "tests/experiments/made_up_sweep.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <sstream>

namespace sofof::experiments::study {

namespace {

/// One vehicle has many short offloadings; with two, each run has another
/// t_off.
void make(const scenario::scenario_definition& s,
          const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream{folder / "summary.json"}
      << R"({"interrupted":false,"safety":{"without_fresh_plan_s":0,)"
         R"("collisions":0,"off_road_s":0},"wall_s":7})";
  std::ofstream{folder / "timing.csv"} << "figure,value\nwall_s,36\n";
  std::ofstream episodes{folder / "episodes.csv"};
  episodes << "side,station,provider,provider_id,service,counter,accepted_s,"
              "first_data_s,ended_s,t_off_s,reason,fallback\n";
  const auto uncertain = s.fleets.front().count == 2;
  for (int i = 1; i <= 4; ++i)
    episodes << fmt::format(
        "requester,101,mec,1,trajectory_planning,{},1,2,3,"
        "{},qos_latency,1\n",
        i, uncertain ? 10.0 * static_cast<double>(s.seed) : 0.5 + 0.01 * i);
}

struct two_points : test::sweep_of_four {
  two_points() {
    std::ofstream{at / "four.toml"}
        << "name = \"four\"\nscenario = \"base.toml\"\nseeds = 2\n"
           "most_seeds = 6\n[[axis]]\nname = \"vehicles\"\n"
           "key = \"fleet.0.count\"\nvalues = [1, 2]\n";
  }

  sweep_plan plan() const { return load_sweep(at / "four.toml"); }

  sweep_options options() {
    auto all = sweep_of_four::options();
    all.make = [this](const scenario::scenario_definition& s,
                      const std::filesystem::path& folder,
                      const std::atomic<bool>&) {
      ++made_runs;
      make(s, folder);
    };
    return all;
  }

  sweep_plan next(const seed_rule& rule = {}) {
    return next_round(plan(), options(), rule, interrupted);
  }

  std::vector<measured_run> run(const sweep_plan& p) {
    return runs_of(p, sweep(p, options(), interrupted, console));
  }

  int made_runs = 0;
};

using counts = std::vector<std::size_t>;

} // namespace

TEST_CASE("a point whose interval is wide gets twice as many seeds") {
  two_points two;
  auto plan = two.plan();
  auto runs = two.run(plan);
  CHECK(runs.size() == 4);
  REQUIRE(add_seeds(plan, runs, {}));
  CHECK(plan.seeds_of == counts{2, 4});
  runs = two.run(plan);
  CHECK(two.made_runs == 6); // those of the first round are not made again
  REQUIRE(add_seeds(plan, runs, {}));
  CHECK(plan.seeds_of == counts{2, 6});
  runs = two.run(plan);
  CHECK(runs.size() == 8);
  CHECK_FALSE(add_seeds(plan, runs, {}));
}

TEST_CASE("a plan that may have no more seeds gets none") {
  two_points two;
  auto plan = two.plan();
  plan.most_seeds = {2};
  CHECK_FALSE(add_seeds(plan, two.run(plan), {}));
  CHECK(plan.size() == 4);
}

TEST_CASE("the next round is found from what lies in the folder") {
  two_points two;
  CHECK(two.next().size() == 4);
  CHECK(two.made_runs == 0);
  two.run(two.plan());
  CHECK(two.next().seeds_of == counts{2, 4});
  CHECK(two.next().seeds_of == counts{2, 4}); // nobody has made it yet
  two.run(two.next());
  CHECK(two.next().seeds_of == counts{2, 6});
  two.run(two.next());
  CHECK(two.next().seeds_of == counts{2, 6});
  CHECK(two.next(full_rule).seeds_of == counts{2, 8});
}

TEST_CASE("the longest effort is judged by runs at a time") {
  two_points two;
  const sweep_plan plans[] = {two.plan()};
  auto options = two.options();
  options.jobs = 2;
  const auto e =
      longest_effort(plans, options, full_rule, two.interrupted, two.console);
  CHECK(two.made_runs == 2);
  CHECK(e.runs == 2 * 60);
  // At most 36 s each, those of one vehicle a little less; two at a time.
  CHECK(e.hours > 0.5);
  CHECK(e.hours <= 0.6);
  CHECK(test::contains(text_of(e), "at most 120 runs, 0.6 hours with 2"));
}

} // namespace sofof::experiments::study
