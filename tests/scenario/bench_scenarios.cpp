// The scenarios of the benchmark: there are nine, and nobody is unsafe in
// them.
#include "scenario/load.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::scenario;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

const std::filesystem::path bench_folder = SOFOF_SOURCE_DIR "/config/bench";

std::set<std::string> names() {
  std::set<std::string> all;
  for (const auto& entry : std::filesystem::directory_iterator{bench_folder})
    all.insert(entry.path().stem().string());
  return all;
}

scenario_definition load_bench(const std::string& name,
                               const std::vector<std::string>& overrides = {}) {
  return load_scenario(bench_folder / (name + ".toml"), overrides);
}

} // namespace

TEST_CASE("the benchmark has its nine scenarios, each under its name") {
  CHECK(names()
        == std::set<std::string>{"corridor_3sp", "coverage_hole", "mixed_fleet",
                                 "rush_hour", "single_intersection", "sp_crash",
                                 "spiky_5g", "tunnel", "two_operators"});
  for (const auto& name : names()) {
    const auto s = load_bench(name);
    CHECK(s.name == name);
    CHECK(s.length == 10min);
    CHECK(s.record.cycles); // violations are counted from them
    CHECK(s.policies.lodm->name() == "location");
  }
}

TEST_CASE("nobody is unsafe in any of them, and somebody offloads") {
  for (const auto& name : names()) {
    CAPTURE(name);
    const auto records = play(load_bench(name, {"duration=70s"}));
    CHECK(records.collisions.empty());
    for (const auto& x : records.safety) {
      CHECK(x.without_fresh_plan == 0ns);
      CHECK(x.off_road == 0ns);
    }
    CHECK(!records.cycles.empty());
  }
}

TEST_CASE("what comes with the program has learned to offload") {
  const auto results = [](const std::string& lodm) {
    return play(load_bench("single_intersection",
                           {"duration=180s", "policies.lodm=" + lodm}))
        .cycles.size();
  };
  const auto most = results("location");
  for (const auto* name : {"q_learning", "dqn"}) {
    CAPTURE(name);
    CHECK(results(name) > most * 9 / 10);
  }
}

TEST_CASE("two operators stall at different times") {
  const auto s = load_bench("two_operators");
  REQUIRE(s.providers.size() == 2);
  CHECK(s.providers[0].position_m == s.providers[1].position_m);
  CHECK(s.providers[0].radio != s.providers[1].radio);
  CHECK(s.channel_to(0)->stalls.rate_hz > 0);
  CHECK(s.channel_to(1)->stalls.rate_hz > 0);
}

TEST_CASE("a hedge saves most of what two providers cost, and keeps most of "
          "what they are worth") {
  const auto drive = [](const std::string& govern) {
    return play(
        load_bench("two_operators",
                   {"duration=180s", "policies.lodm={name=\"location\",govern=["
                                         + govern + "]}"}));
  };
  const auto alone = drive("");
  const auto both = drive(R"({name="redundancy"})");
  const auto hedged = drive(R"({name="redundancy",hedge_after="20ms"})");
  const auto fallbacks = [](const memory_sink& records) {
    return std::ranges::count(records.episodes, true,
                              &episode_record::fallback);
  };
  CHECK(both.cycles.size() > alone.cycles.size() * 19 / 10);
  CHECK(hedged.cycles.size() < alone.cycles.size() * 13 / 10);
  CHECK(fallbacks(alone) >= 6);
  CHECK(fallbacks(hedged) <= fallbacks(alone) / 3);
}

TEST_CASE("in the corridor some provider offers everywhere, two at places") {
  const auto s = load_bench("corridor_3sp");
  REQUIRE(s.providers.size() == 3);
  auto several = 0;
  for (auto x_m = 0.0; x_m <= 1400; x_m += 10) {
    auto offering = 0;
    for (const auto& p : s.providers)
      offering += p.area().contains({x_m, 0});
    CHECK(offering >= 1);
    several += offering >= 2;
  }
  CHECK(several >= 40);
}
