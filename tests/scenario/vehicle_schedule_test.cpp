// Functions of a vehicle that share its cores: what is stated before a run, and
// how it drives.
#include "scenario/vehicle_schedule.hpp"

#include "tests/scenario/example.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::scenario;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

using overrides = std::vector<std::string>;

const std::filesystem::path light_chain =
    std::filesystem::path{SOFOF_SOURCE_DIR} / "config/chain/light.toml";

overrides with_cores(std::string_view order, int cores) {
  const std::string table = "fleet.0.compute.";
  return {table + "scheduling=" + std::string{order},
          table + "cores=" + std::to_string(cores)};
}

vehicle_schedule chain_on(std::string_view order, int cores) {
  return schedule_at_home(load_scenario(light_chain, with_cores(order, cores)),
                          0)
      .value();
}

/// At home, with functions that take most of a core.
memory_sink driven(const overrides& set) {
  auto all = set;
  for (const auto* more : {"duration=30s", "policies.lodm=never",
                           "service.0.compute.run_time_mean=8ms",
                           "service.1.compute.run_time_mean=12ms",
                           "service.2.compute.run_time_mean=22ms"})
    all.emplace_back(more);
  return play(load_scenario(light_chain, all));
}

} // namespace

TEST_CASE("functions share no cores unless they are to") {
  const auto all = example::load();
  CHECK(!schedule_at_home(all, 0));
  CHECK(to_toml(all).find("scheduling") == std::string::npos);
  const auto none =
      example::load(example::text, {"fleet.0.compute.scheduling=none"});
  CHECK(to_toml(none) == to_toml(all));
}

TEST_CASE("how cores are shared stands in the effective configuration") {
  const auto text = to_toml(example::load(example::text, with_cores("edf", 2)));
  CHECK(text.find("scheduling = \"edf\"\ncores = 2\nstrict = false\n")
        != text.npos);
  CHECK(to_toml(example::load(text)) == text);
}

TEST_CASE("options without effect, and unknown words, are refused") {
  const auto error = [](const overrides& set) {
    return example::error_of(example::text, set);
  };
  CHECK(error({"fleet.0.compute.scheduling=fifo"})
            .find("\"fifo\" is no scheduling")
        != std::string::npos);
  CHECK(error({"fleet.0.compute.cores=2"})
            .find("has no effect without scheduling")
        != std::string::npos);
  CHECK(error({"fleet.0.compute.strict=true"})
            .find("has no effect without scheduling")
        != std::string::npos);
  CHECK(error({"fleet.0.compute.scheduling=edf", "vehicle_host.cores=4",
               "vehicle_host.busy_cores=0.1"})
            .find("[vehicle_host]")
        != std::string::npos);
}

TEST_CASE("what each function takes at most is stated, with all at home") {
  const auto one = chain_on("fixed_priority", 1);
  CHECK(one.first_station == 101);
  CHECK(one.vehicles == 6);
  REQUIRE(one.functions.size() == 3);
  // Longest draws: 4.58, 7.3 and 22.7 ms; three of each of the first two may
  // come at once, and a fourth 50 ms later.
  CHECK(one.functions[0].at_most.value() == 4580us);
  CHECK(one.functions[1].at_most.value() == 7300us + 3 * 4580us);
  CHECK(one.functions[2].at_most.value() == 22700us + 4 * (4580us + 7300us));
  CHECK(to_comment(one)
        == "# All functions of vehicles 101 to 106 at home, by fixed "
           "priorities on 1 core; load 69 %.\n"
           "#   tracking: 4.6 ms at most; limit 50.0 ms.\n"
           "#   environment_model: 21.0 ms at most; limit 50.0 ms.\n"
           "#   trajectory_planning: 70.2 ms at most; limit 50.0 ms.\n");
  CHECK(warning_of(one)
        == "vehicles 101 to 106 may be too slow to take all functions back: "
           "with all at home a result of \"trajectory_planning\" takes 70.2 ms "
           "at most, where 50.0 ms are allowed; more cores, a faster clock or "
           "another order of services may do.");
}

TEST_CASE("by deadlines that are alike, or with another core, the same "
          "functions come home in time") {
  const auto by_deadlines = chain_on("edf", 1);
  for (const auto& one : by_deadlines.functions)
    CHECK(one.at_most.value() == 34580us); // one of each
  CHECK(warning_of(by_deadlines).empty());
  const auto two = chain_on("fixed_priority", 2);
  CHECK(two.functions[2].core != two.functions[0].core);
  CHECK(two.functions[2].at_most.value() == 22700us);
  CHECK(warning_of(two).empty());
  CHECK(to_comment(two).find("environment_model (core 1): 21.0 ms at most")
        != std::string::npos);
}

TEST_CASE("a slower clock takes longer, at most a period") {
  auto set = with_cores("fixed_priority", 2);
  set.emplace_back("fleet.0.compute.clock_ghz=1.5");
  const auto slow =
      schedule_at_home(load_scenario(light_chain, set), 0).value();
  CHECK(slow.functions[2].at_most.value() == 45400us);
}

TEST_CASE("a vehicle that cannot take its functions back is refused, if it is "
          "to be, with its place in the file") {
  auto set = with_cores("fixed_priority", 1);
  set.emplace_back("fleet.0.compute.strict=true");
  std::string why;
  try {
    load_scenario(light_chain, set);
  } catch (const input_error& problem) {
    why = problem.what();
  }
  CHECK(why.find("fleet.0.compute.strict") != why.npos);
  CHECK(why.find("\"trajectory_planning\" takes 70.2 ms at most") != why.npos);
  set[1] = "fleet.0.compute.cores=2";
  CHECK_NOTHROW(load_scenario(light_chain, set));
}

TEST_CASE("vehicles whose functions share cores drive safely, each time the "
          "same, and not as those whose functions do not") {
  const auto alone = driven({});
  for (const auto* order : {"fixed_priority", "edf"}) {
    CAPTURE(order);
    const auto run = driven(with_cores(order, 1));
    CHECK(run.collisions.empty());
    for (const auto& x : run.safety)
      CHECK(x.without_fresh_plan == 0ms);
    const auto again = driven(with_cores(order, 1));
    REQUIRE(run.tracks.size() > 100);
    REQUIRE(run.tracks.size() == again.tracks.size());
    REQUIRE(run.tracks.size() == alone.tracks.size());
    bool differs = false;
    for (std::size_t i = 0; i < run.tracks.size(); ++i) {
      const auto& position = run.tracks[i].ego.own.position;
      CHECK(position == again.tracks[i].ego.own.position);
      differs = differs || !(position == alone.tracks[i].ego.own.position);
    }
    CHECK(differs);
  }
}
