// The same command gives the same bytes, and a decision changes nobody's luck.
#include "tests/processes/results_reader.hpp"
#include "tests/processes/workplace.hpp"

#include <set>
#include <utility>

using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator{folder})
    names.insert(entry.path().filename());
  return names;
}

nlohmann::json timeless_summary_of(const fs::path& folder) {
  auto summary = summary_of(folder);
  CHECK(summary.erase("timing") == 1);
  CHECK(summary.erase("wall_s") == 1);
  return summary;
}

/// @returns whether all lines of `part` begin `whole`.
bool is_prefix(const fs::path& part, const fs::path& whole) {
  const auto text = read_file(part);
  return !text.empty() && read_file(whole).starts_with(text);
}

/// Station and number of a cycle.
using cycle_name = std::pair<std::string, std::string>;

} // namespace

TEST_CASE("the same command twice gives the same bytes") {
  const workplace at;
  const auto a = at.drive("a", {"--duration", "300s"});
  const auto b = at.drive("b", {"--duration", "300s"});
  CHECK(names_in(a)
        == std::set<std::string>{
            "config.toml", "cycles.csv", "distributions.csv", "energy.csv",
            "episodes.csv", "events.jsonl", "load.csv", "map.toml",
            "octets.csv", "disturbed.csv", "responses.csv", "summary.json",
            "timing.csv", "tracks.csv", "vehicles.csv"});
  CHECK(names_in(b) == names_in(a));
  for (const auto& name : names_in(a))
    if (name != "timing.csv" && name != "summary.json") {
      CAPTURE(name);
      CHECK_FALSE(read_file(a / name).empty());
      CHECK((read_file(a / name) == read_file(b / name)));
    }
  CHECK(timeless_summary_of(a) == timeless_summary_of(b));
  // The timing comes last, so that what is before it can be compared, too.
  const auto text = read_file(a / "summary.json");
  const auto timeless = text.substr(0, text.find("\"timing\""));
  CHECK((read_file(b / "summary.json").starts_with(timeless)));
}

TEST_CASE("another seed is another run") {
  const workplace at;
  const auto a = at.drive("a", {"--duration", "60s"});
  const auto b = at.drive("b", {"--duration", "60s", "--seed", "2"});
  for (const auto* name : {"cycles.csv", "tracks.csv", "events.jsonl"}) {
    CAPTURE(name);
    CHECK((read_file(a / name) != read_file(b / name)));
  }
}

TEST_CASE("a shorter run is the beginning of a longer one") {
  const workplace at;
  const auto brief = at.drive("brief", {"--duration", "60s"});
  const auto longer = at.drive("longer", {"--duration", "120s"});
  for (const auto* name : {"cycles.csv", "tracks.csv"}) {
    CAPTURE(name);
    CHECK(rows_of(brief / name).size() > 1000);
    CHECK(is_prefix(brief / name, longer / name));
  }
}

TEST_CASE("who does not offload drives the same, whatever others may do") {
  const workplace at;
  const std::string length = "60s"; // only 101 and 102 get there by then
  const auto offloading = at.drive("offloading", {"--duration", length});
  const auto never =
      at.drive("never", {"--duration", length, "--set", "policies.codm=never"});
  CHECK(rows_of(never / "cycles.csv").empty());
  const auto local_tracks = [](const fs::path& folder) {
    auto rows = rows_of(folder / "tracks.csv");
    std::erase_if(rows, [](const row& r) {
      return r.at("station") == "101" || r.at("station") == "102";
    });
    return rows;
  };
  const auto alone = local_tracks(never);
  CHECK(alone.size() == 4 * 600);
  CHECK((local_tracks(offloading) == alone));
  for (const auto& r : alone)
    REQUIRE(r.at("source") == "local");
}

TEST_CASE("a decision changes nobody's delays") {
  // Enough workers that nobody waits for anybody.
  const std::vector<std::string> common{"--duration", "120s", "--set",
                                        "compute.workers=64"};
  auto smaller = common;
  smaller.insert(smaller.end(), {"--set", "provider.mec.area_radius_m=250"});
  const workplace at;
  std::map<cycle_name, row> in_large_area;
  for (auto& r : rows_of(at.drive("large", common) / "cycles.csv"))
    if (r.at("service") == "trajectory_planning")
      in_large_area.emplace(cycle_name{r.at("station"), r.at("cycle")}, r);

  // The first results of an episode queue up behind the start message.
  constexpr auto until_queue_is_empty = 5;
  std::map<cycle_name, int> results;
  auto compared = 0;
  for (const auto& r : rows_of(at.drive("small", smaller) / "cycles.csv")) {
    const auto found = in_large_area.find({r.at("station"), r.at("cycle")});
    if (r.at("service") != "trajectory_planning" || found == in_large_area.end()
        || ++results[{r.at("station"), r.at("counter")}]
               <= until_queue_is_empty)
      continue;
    ++compared;
    REQUIRE(r.at("created_s") == found->second.at("created_s"));
    REQUIRE(r.at("latency_ms") == found->second.at("latency_ms"));
  }
  CHECK(compared > 1000);
}
