// Scenarios whose network depends on places, and vehicles that foresee it.
#include "base/input_error.hpp"
#include "scenario/forecasts.hpp"
#include "scenario/load.hpp"
#include "scenario/place_oracle.hpp"
#include "scenario/quality_file.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::scenario;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

const std::filesystem::path hole_file =
    SOFOF_SOURCE_DIR "/config/bench/coverage_hole.toml";
constexpr std::string_view gated =
    R"(policies.lodm={name="location",govern=[{name="predictive_gate"}]})";

scenario_definition load_hole(std::vector<std::string> overrides = {}) {
  return load_scenario(hole_file, overrides);
}

/// A run of four minutes: about four rounds of each car.
memory_sink drive_with(const std::string& source) {
  return play(load_hole({"duration=240s", std::string{gated},
                         "policies.forecast.source=" + source}));
}

auto fallbacks(const memory_sink& records) {
  return std::ranges::count(records.episodes, true, &episode_record::fallback);
}

/// A file that goes with the test.
struct scratch_file {
  std::filesystem::path path = std::filesystem::temp_directory_path()
                               / fmt::format("sofof_quality_{}.csv", getpid());

  void write(std::string_view text) const { std::ofstream{path} << text; }
  ~scratch_file() {
    std::error_code nothing;
    std::filesystem::remove(path, nothing);
  }
};

std::string error_of_quality(const scratch_file& at, std::string_view text) {
  at.write(text);
  try {
    read_quality(at.path, load_hole());
  } catch (const input_error& problem) {
    return problem.what();
  }
  return {};
}

constexpr std::string_view quality_header =
    "provider,service,x_m,y_m,visits,late,latency_s\n";

} // namespace

TEST_CASE("who has learned where holes are falls back less often than who has "
          "not, and who knew before hardly ever") {
  const auto without = fallbacks(drive_with("none"));
  const auto learned = fallbacks(drive_with("learned"));
  const auto known = fallbacks(drive_with("oracle"));
  CHECK(without >= 12);
  CHECK(learned <= without * 2 / 3);
  CHECK(known <= learned);
  CHECK(known <= 1);
}

TEST_CASE("what is learned is the same each time, and where the holes are") {
  const auto learn = [] {
    const auto s = load_hole({"duration=90s", std::string{gated}});
    auto records = std::make_shared<memory_sink>();
    const auto time = make_virtual_runtime();
    const auto actors = build(time->system(), s, records, time->clock(), true);
    time->run_until(time->now() + s.length);
    dismiss(actors, *time);
    return actors.forecasts->learned_csv();
  };
  const auto csv = learn();
  CHECK(csv == learn());
  const scratch_file at;
  at.write(csv);
  const auto s = load_hole();
  auto late = 0;
  for (const auto& x : read_quality(at.path, s))
    if (x.known.late > 0) {
      ++late;
      CAPTURE(x.at.x_m);
      CAPTURE(x.at.y_m);
      // A cell of 10 m, and some metres until lateness is noticed.
      const auto near = [&](point corner) {
        const auto there = x.at + corner;
        return channel::quality_at(s.network.channel->areas, there)
               != channel::place_quality{};
      };
      CHECK((near({0, 0}) || near({12, 0}) || near({-12, 0}) || near({0, 12})
             || near({0, -12})));
    }
  CHECK(late >= 4);
}

TEST_CASE("a later run begins with what an earlier one has learned") {
  const scratch_file at;
  policies::quality_map map;
  map.add("trajectory_planning", 1, {15, 15}, {4, 3, 0.08});
  at.write(quality_csv(map, load_hole()));
  for (const auto* source : {"learned", "file"}) {
    const auto s = load_hole(
        {fmt::format("policies.forecast.source={}", source),
         fmt::format("policies.forecast.file=\"{}\"", at.path.string())});
    place_forecasts all{s};
    const auto forecast = all.for_vehicle();
    REQUIRE(forecast);
    const auto there = forecast->look(1, "trajectory_planning", {155, 155});
    CHECK(there.late > 0.4);
    CHECK(there.latency_s == doctest::Approx(0.08));
    CHECK(forecast->look(1, "trajectory_planning", {0, 0}).late < 0.05);
    CHECK(all.learned_csv().empty() == (source == std::string{"file"}));
  }
}

TEST_CASE("a file of places that is wrong is refused with file and line") {
  const scratch_file at;
  const auto says = [&](std::string_view row, std::string_view word) {
    CAPTURE(row);
    const auto error =
        error_of_quality(at, fmt::format("{}{}\n", quality_header, row));
    CHECK(error.find(at.path.filename().string() + ":2") != error.npos);
    CHECK(error.find(word) != error.npos);
  };
  CHECK(error_of_quality(at, quality_header) == "");
  CHECK(
      error_of_quality(at, fmt::format("{}mec,trajectory_planning,5,5,1,1,0\n",
                                       quality_header))
      == "");
  says("mecc,trajectory_planning,5,5,1,1,0", "mec");
  says("mec,planning,5,5,1,1,0", "trajectory_planning");
  says("mec,trajectory_planning,5,5,1,2,0", "must not be more than visits");
  says("mec,trajectory_planning,5,5,-1,0,0", "must not be negative");
  says("mec,trajectory_planning,5,north,1,0,0", "north");
  says("mec,trajectory_planning,5,5,1", "");
  CHECK(!error_of_quality(at, "provider,service\n").empty());
}

TEST_CASE("the oracle knows the law of each place") {
  const auto s = load_hole();
  const auto oracle = foresee_places(s)();
  const auto at = [&](point p) {
    return oracle->look(1, "trajectory_planning", p);
  };
  CHECK(at({150, 150}).late > 0.99);
  CHECK(at({150, 190}).late < 0.05);
  CHECK(at({300, 80}).late > 0.9);
  CHECK(at({0, 0}).latency_s == doctest::Approx(0.012).epsilon(0.1));
  CHECK(at({150, 150}).latency_s > at({0, 0}).latency_s + 0.039);
  CHECK(oracle->look(7, "trajectory_planning", {0, 0}).late == 0);
  CHECK(oracle->look(1, "climate", {0, 0}).late == 0);
}

TEST_CASE("areas of a provider's own network are its own") {
  const auto s = load_hole({"provider.mec.network.profile=\"paper_5g\""});
  CHECK(s.channel_to(0)->areas.empty());
  CHECK(s.network.channel->areas.size() == 2);
}

TEST_CASE("a scenario without areas and forecasts prints neither") {
  const auto text =
      to_toml(load_scenario(SOFOF_SOURCE_DIR "/config/bench/tunnel.toml",
                            std::vector<std::string>{}));
  CHECK(text.find("area =") == text.npos);
  CHECK(text.find("network.area") == text.npos);
  CHECK(text.find("forecast") == text.npos);
  const auto hole = to_toml(load_hole());
  CHECK(hole.find("network.area") != hole.npos);
  CHECK(hole.find("policies.forecast") != hole.npos);
}
