// Schemas of files that people write.
#include "base/input_error.hpp"
#include "experiments/schema/file_schemas.hpp"
#include "experiments/sweep/plan.hpp"
#include "scenario/load.hpp"
#include "scenario/map_file.hpp"
#include "tests/experiments/schema_mistakes.hpp"
#include "tests/support/files.hpp"
#include "tests/support/schema_check.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>

using namespace sofof;
using namespace sofof::test;
namespace fs = std::filesystem;
namespace schema = sofof::experiments::schema;

namespace {

schema_check schema_check_of(std::string_view kind) {
  return schema_check(nlohmann::json::parse(schema::schema_of(kind)));
}

nlohmann::json toml_as_json(std::string_view text) {
  return json_of(toml::parse(text));
}

std::string with_mistake(std::string_view right, const mistake& one) {
  std::string text{right};
  const auto at = text.find(one.right);
  REQUIRE(at != text.npos);
  return text.replace(at, one.right.size(), one.wrong);
}

using file_reader = std::function<void(const std::string& text)>;

bool is_refused(const file_reader& read, const std::string& text) {
  try {
    read(text);
    return false;
  } catch (const input_error&) {
    return true;
  }
}

void check_mistakes(std::string_view kind, std::string_view right,
                    std::span<const mistake> mistakes,
                    const file_reader& read) {
  auto check = schema_check_of(kind);
  CHECK(check(toml_as_json(right)) == "");
  read(std::string{right});
  for (const auto& one : mistakes) {
    CAPTURE(one.right);
    CAPTURE(one.wrong);
    const auto text = with_mistake(right, one);
    CHECK(check(toml_as_json(text)) != "");
    CHECK(is_refused(read, text));
  }
}

/// @returns the kind of a file in config/.
std::string_view kind_of(const fs::path& file, const std::string& text) {
  if (file.filename() == "policies.toml")
    return "entrants";
  if (text.find("\n[[lane]]") != text.npos)
    return "map";
  return text.find("\nscenario = ") == text.npos ? "scenario" : "sweep";
}

/// Calls for each table of a schema that lists options.
void for_each_properties(
    const nlohmann::json& part,
    const std::function<void(const nlohmann::json& properties)>& call) {
  if (part.is_object() && part.contains("properties")
      && part["properties"].is_object() && part.contains("type"))
    call(part["properties"]);
  for (const auto& inner : part)
    if (inner.is_structured())
      for_each_properties(inner, call);
}

} // namespace

TEST_CASE("The schemas accept every file in config") {
  const fs::path config{SOFOF_SOURCE_DIR "/config"};
  std::size_t files = 0;
  std::map<std::string, schema_check, std::less<>> checks;
  for (const auto kind : schema::file_kinds)
    checks.emplace(kind, schema_check_of(kind));
  for (const auto& entry : fs::recursive_directory_iterator{config}) {
    if (entry.path().extension() != ".toml")
      continue;
    CAPTURE(entry.path().string());
    const auto text = read_file(entry.path());
    const auto kind = kind_of(entry.path(), text);
    CAPTURE(kind);
    CHECK(checks.find(kind)->second(toml_as_json(text)) == "");
    ++files;
  }
  CHECK(files > 40);
  const auto first = read_file(SOFOF_SOURCE_DIR "/apps/new/scenario.toml");
  CHECK(checks.find("scenario")->second(toml_as_json(first)) == "");
}

TEST_CASE("The schema accepts what `sofof check` prints of a scenario") {
  auto check = schema_check_of("scenario");
  for (const auto* name : {"ulm_lehr", "coverage_hole", "busy_worker", "city",
                           "chain/light", "paper/round_trip"}) {
    CAPTURE(name);
    const auto all = scenario::load_scenario(
        fs::path{SOFOF_SOURCE_DIR "/config"} / (std::string{name} + ".toml"));
    CHECK(check(toml_as_json(scenario::to_toml(all))) == "");
  }
}

TEST_CASE("The schema of scenarios refuses what the program refuses") {
  check_mistakes("scenario", right_scenario, scenario_mistakes,
                 [](const std::string& text) {
                   scenario::parse_scenario(text, "made_up.toml");
                 });
}

TEST_CASE("The schema of maps refuses what the program refuses") {
  check_mistakes("map", right_map, map_mistakes, [](const std::string& text) {
    scenario::parse_map(text, "made_up.toml");
  });
}

TEST_CASE("The schema of sweeps refuses what the program refuses") {
  check_mistakes("sweep", right_sweep, sweep_mistakes,
                 [](const std::string& text) {
                   experiments::parse_sweep(text, "made_up.toml");
                 });
}

TEST_CASE("The schema of sweeps knows the options of scenarios") {
  const auto base = read_file(SOFOF_SOURCE_DIR "/config/ulm_lehr.toml");
  check_mistakes(
      "sweep", right_sweep, sweep_key_mistakes, [&](const std::string& text) {
        const fs::path folder{SOFOF_SOURCE_DIR "/config"};
        const auto plan = experiments::parse_sweep(text, folder / "x.toml");
        const auto points = experiments::points_of(plan);
        scenario::parse_scenario(base, folder / "ulm_lehr.toml",
                                 points.front().given);
      });
}

TEST_CASE("A former place of an option is accepted, and said to be one") {
  auto check = schema_check_of("scenario");
  CHECK(check(toml_as_json("network.workers = 2\n"
                           "fleet = [{ computer = { clock_ghz = 2.0 } }]\n"))
        == "");
  CHECK(check(toml_as_json("network.workers = 0\n")) != "");
  const auto all = nlohmann::json::parse(schema::schema_of("scenario"));
  CHECK(all["definitions"]["fleet"]["properties"]["computer"]["deprecated"]
        == true);
}

TEST_CASE("The schemas say what each option means") {
  for (const auto* kind : {"scenario", "map", "sweep"}) {
    std::set<std::string> silent;
    const auto all = nlohmann::json::parse(schema::schema_of(kind));
    for_each_properties(all, [&](const nlohmann::json& properties) {
      for (const auto& [key, option] : properties.items())
        if (!option.contains("description") && !option.contains("allOf")
            && !option.contains("items") && key != "name")
          silent.insert(key);
    });
    if (std::string_view{kind} == "sweep")
      continue; // what it changes is described in the scenario's
    std::string keys;
    for (const auto& key : silent)
      keys += key + ' ';
    CAPTURE(kind);
    CHECK(keys == "");
  }
}

TEST_CASE("There is no schema of another kind of file") {
  CHECK_THROWS_WITH_AS(schema::schema_of("scenarios"),
                       "\"scenarios\" is no kind of file with a schema, did "
                       "you mean \"scenario\"? Known: scenario, map, sweep, "
                       "entrants.",
                       input_error);
}
