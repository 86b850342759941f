// Maps of providers: their own, an old one, or none.
#include "scenario/map_file.hpp"
#include "scenario/run.hpp"
#include "tests/scenario/example.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::scenario;
using namespace sofof::test;

namespace {

const std::filesystem::path corridor =
    std::filesystem::path{SOFOF_SOURCE_DIR} / "config/bench/corridor_3sp.toml";

/// Cars on a straight road past three providers.
scenario_definition drive_past(const std::vector<std::string>& changes,
                               std::string_view length = "duration=60s") {
  auto all = changes;
  all.emplace_back(length);
  return load_scenario(corridor, all);
}

std::size_t count(const memory_sink& records, event_type what,
                  std::string_view detail = {}) {
  return static_cast<std::size_t>(
      std::ranges::count_if(records.events, [&](const event_record& x) {
        return x.what == what && (detail.empty() || x.detail == detail);
      }));
}

/// The run past providers with an old map: the scenario's, in which each number
/// behind some words was another one.
memory_sink drive_past_old(const std::string& behind,
                           const std::function<double(double)>& was) {
  auto s = drive_past({});
  std::string text;
  auto at = s.map_text.cbegin();
  const std::regex place{"(" + behind + ")(-?[0-9.]+)"};
  for (std::sregex_iterator x{at, s.map_text.cend(), place}, end; x != end;
       ++x) {
    const auto& found = *x;
    text.append(at, found[2].first);
    text += fmt::format("{:.1f}", was(std::stod(found[2])));
    at = found[2].second;
  }
  text.append(at, s.map_text.cend());
  REQUIRE(text != s.map_text);
  for (auto& p : s.providers)
    p.streets = parse_map(text, corridor);
  return play(s);
}

/// When results came, and how old they were.
std::vector<std::pair<time_point, time_point>>
received(const memory_sink& records) {
  std::vector<std::pair<time_point, time_point>> all;
  for (const auto& x : records.cycles)
    all.emplace_back(x.received, x.created);
  return all;
}

void check_safe(const memory_sink& records) {
  CHECK(count(records, event_type::accepted) > 0);
  CHECK(records.collisions.empty());
  for (const auto& x : records.safety) {
    CHECK(x.off_road == duration{0});
    CHECK(x.without_fresh_plan == duration{0});
  }
}

const std::vector<std::string> nobody_has_a_map{"provider.west.map=none",
                                                "provider.middle.map=none",
                                                "provider.east.map=none"};

} // namespace

TEST_CASE("a provider without a map refuses whoever asks, as none is present") {
  const auto records = play(drive_past(nobody_has_a_map));
  CHECK(count(records, event_type::request) > 50);
  CHECK(count(records, event_type::refused, "no map present")
        == count(records, event_type::refused));
  CHECK(count(records, event_type::refused) > 50);
  CHECK(count(records, event_type::accepted) == 0);
}

TEST_CASE("without a map a provider plans for nobody, whatever its CODM says") {
  auto changes = nobody_has_a_map;
  changes.emplace_back("policies.codm=always");
  const auto records = play(drive_past(changes));
  CHECK(count(records, event_type::refused, "no map present") > 50);
  CHECK(count(records, event_type::accepted) == 0);
}

TEST_CASE("a provider's own map that is the scenario's changes nothing") {
  const std::vector<std::string> own{"provider.west.map=../maps/corridor.toml"};
  const auto with = play(drive_past(own)), without = play(drive_past({}));
  CHECK(with.cycles.size() > 1000);
  CHECK(received(with) == received(without));
}

TEST_CASE(
    "where a provider's map has another limit, vehicles refuse plans that "
    "are too fast for their own map") {
  const auto records =
      drive_past_old("limit_mps = ", [](double v) { return 1.5 * v; });
  check_safe(records);
  CHECK(count(records, event_type::implausible) > 0);
}

TEST_CASE("where a road has been moved since a provider's map was made, it "
          "refuses, whatever its CODM says, and vehicles plan themselves") {
  const auto records =
      drive_past_old("\\[[0-9.]+, ", [](double y_m) { return y_m + 1; });
  CHECK(count(records, event_type::refused, "route is not on the map")
        == count(records, event_type::refused));
  CHECK(count(records, event_type::refused) > 50);
  CHECK(count(records, event_type::accepted) == 0);
}

TEST_CASE("a provider's map of another origin is refused, and one that is not "
          "there") {
  const auto error = [](std::string_view map) {
    return example::error_of(
        example::with("area_radius_m = 80.0", "area_radius_m = 80.0\nmap = \""
                                                  + std::string{map} + "\""));
  };
  CHECK(error("ring.toml").empty());
  CHECK(error("none").empty());
  CHECK(error("").find("leave it out") != std::string::npos);
  CHECK(error("nowhere.toml").find("cannot be read") != std::string::npos);
  CHECK(error("../../../config/maps/corridor.toml").find("another origin")
        != std::string::npos);
}

TEST_CASE("a results folder has a copy of a provider's map, which its "
          "configuration names") {
  const auto s = example::load(example::with(
      "area_radius_m = 80.0", "area_radius_m = 80.0\nmap = \"ring.toml\""));
  CHECK(configuration_of(s).find("map = \"map_of_provider_1.toml\"")
        != std::string::npos);
}
