// Broken promises that are planted in a run's results are found.
#include "base/options/toml_file.hpp"
#include "experiments/sweep/run_maker.hpp"
#include "experiments/torture/check_ledger.hpp"
#include "experiments/torture/promises.hpp"
#include "scenario/load.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::experiments::torture;
namespace fs = std::filesystem;

namespace {

constexpr std::string_view scene = R"(name = "scene"
duration = "30s"
seed = 3
[street_grid]
columns = 2
rows = 2
[[fleet]]
count = 2
routes = ["block *"]
[[provider]]
area_radius_m = 500.0
[network]
loss = 0.05
[[service]]
name = "trajectory_planning"
[service.planner]
name = "lane_follow"
[policies]
lodm = "always"
codm = "always"
[record]
tracks = false
trace = true
)";

const scenario::scenario_definition& the_scene() {
  static const auto loaded = scenario::parse_scenario(scene, "scene.toml");
  return loaded;
}

/// The results of one honest run, made once.
const fs::path& honest() {
  static const test::scratch at;
  static const auto folder = [] {
    const std::atomic<bool> interrupted{false};
    experiments::virtual_runs("", false)(the_scene(), at / "run", interrupted);
    return at / "run";
  }();
  return folder;
}

using lines = std::vector<std::string>;

/// A copy of them, of which a file's lines may be changed.
struct planted {
  test::scratch at;

  planted() { fs::copy(honest(), at.path(), fs::copy_options::recursive); }

  template <class Change>
  void change(std::string_view file, Change change) {
    lines all;
    std::ifstream in{at / file};
    for (std::string line; std::getline(in, line);)
      all.push_back(line);
    change(all);
    std::ofstream out{at / file};
    for (const auto& line : all)
      out << line << '\n';
  }

  bool breaks(std::string_view promise) const {
    const auto found = check(read_finished(the_scene(), at.path()));
    for (const auto& x : found)
      MESSAGE(x.promise << ": " << x.what);
    return std::ranges::find(found, promise, &broken_promise::promise)
           != found.end();
  }
};

/// The first line that begins so.
lines::iterator first(lines& all, std::string_view begin) {
  const auto found = std::ranges::find_if(
      all, [&](const auto& line) { return line.starts_with(begin); });
  REQUIRE(found != all.end());
  return found;
}

/// Sets a field of a line of a CSV file.
void set(std::string& line, int column, std::string_view value) {
  std::size_t from = 0;
  for (; column > 0; --column)
    from = line.find(',', from) + 1;
  line.replace(from, line.find(',', from) - from, value);
}

} // namespace

TEST_CASE("an honest run breaks no promise, and is counted") {
  const auto run = read_finished(the_scene(), honest());
  for (const auto& x : check(run))
    FAIL_CHECK(x.promise << ": " << x.what);
  const auto counts = count(run);
  CHECK(counts[counted::driven_s] == doctest::Approx(60));
  CHECK(counts[counted::al_ilqr_s] == 0);
  CHECK(counts[counted::offloaded_s] > 20);
  CHECK(counts[counted::episodes] > 2);
  CHECK(counts[counted::sessions] >= counts[counted::episodes]);
  CHECK(counts[counted::loss] > 10);
  CHECK(counts[counted::crash] == 0);
}

TEST_CASE("a session that the provider never closed is found") {
  planted p;
  p.change("episodes.csv",
           [](lines& all) { all.erase(first(all, "provider,")); });
  CHECK(p.breaks("closed_by_both"));
}

TEST_CASE("a session that was closed twice is found") {
  planted p;
  p.change("episodes.csv", [](lines& all) {
    const auto line = *first(all, "requester,");
    all.push_back(line);
  });
  CHECK(p.breaks("closed_once"));
}

TEST_CASE(
    "a session that the provider closed late, though the link carried, is "
    "found") {
  planted p;
  p.change("episodes.csv", [](lines& all) {
    set(*first(all, "provider,"), 8, "29.500000000");
  });
  CHECK(p.breaks("closed_in_time")); // though messages are lost by chance
}

TEST_CASE("a session that the vehicle does not know, and the provider keeps "
          "until the end, is found") {
  planted p;
  p.change("episodes.csv", [](lines& all) {
    auto kept = *first(all, "provider,");
    set(kept, 5, "4000"); // another one's counter
    set(kept, 8, "30.000000000");
    all.push_back(kept);
  });
  CHECK(p.breaks("closed_by_both"));
}

TEST_CASE("a session that the provider had not closed when it died is found, "
          "if it had the time") {
  for (const auto* dies : {"8s", "29.9s"}) {
    CAPTURE(dies);
    auto what = scenario::parse_scenario(
        std::string{scene}.replace(scene.find("area_radius_m"), 0,
                                   fmt::format("fails_at = \"{}\"\n", dies)),
        "scene.toml");
    planted p;
    double ended_s = 0;
    p.change("episodes.csv", [&](lines& all) {
      const auto line = first(all, "requester,");
      set(*line, 8, "7.900000000");
      const auto key =
          line->substr(line->find(','),
                       line->find(",trajectory_planning,") - line->find(','));
      ended_s = 7.9;
      std::erase_if(
          all, [&](const auto& x) { return x.starts_with("provider" + key); });
    });
    const auto found = check(read_finished(what, p.at.path()));
    CHECK((std::ranges::find(found, "closed_by_both", &broken_promise::promise)
           != found.end())
          == (std::string_view{dies} != "8s"));
  }
}

TEST_CASE("the link's trouble is no lateness") {
  CHECK(calm_within({}, 1, 4) == 3);
  CHECK(calm_within({{0.5, 1.5}, {2, 3}, {3.5, 7}}, 1, 4)
        == doctest::Approx(1));
  CHECK(calm_within({{3, 4}}, 1, 4) == 2);
}

TEST_CASE("a late result that was used is found") {
  planted p;
  p.change("cycles.csv", [](lines& all) { set(all.at(5), 8, "50.000001"); });
  CHECK(p.breaks("in_time"));
}

TEST_CASE("a result that is used twice is found") {
  planted p;
  p.change("cycles.csv", [](lines& all) {
    const auto twice = all.at(9);
    all.insert(all.begin() + 10, twice);
  });
  CHECK(p.breaks("in_order"));
}

TEST_CASE("a result of a session that is over is found") {
  planted p;
  p.change("cycles.csv", [](lines& all) { set(all.at(9), 7, "29.9"); });
  CHECK(p.breaks("one_source"));
}

TEST_CASE("a gap that nobody noticed is found") {
  planted p;
  p.change("cycles.csv",
           [](lines& all) { all.erase(all.begin() + 20, all.begin() + 60); });
  CHECK(p.breaks("no_gap"));
}

TEST_CASE("figures that do not add up are found") {
  planted p;
  p.change("summary.json", [](lines& all) {
    for (auto& line : all)
      if (line.find("\"fallbacks\":") != std::string::npos)
        line = "  \"fallbacks\": 77,";
  });
  CHECK(p.breaks("adds_up"));
}

TEST_CASE("octets that vanish are found") {
  planted p;
  p.change("octets.csv", [](lines& all) { set(all.at(3), 6, "1"); });
  CHECK(p.breaks("octets"));
}

TEST_CASE("a moment without a fresh plan is found") {
  planted p;
  p.change("vehicles.csv",
           [](lines& all) { set(all.at(1), 3, "0.010000000"); });
  CHECK(p.breaks("fresh_plan"));
  CHECK(p.breaks("adds_up")); // the summary does not know of it
}

TEST_CASE("an honest provider that is taken for a liar is found, unless for "
          "what it may not see") {
  const auto objects_to = [](std::string_view why) {
    return [why](lines& all) {
      const auto end = first(all, R"({"t_s":)");
      auto line = *end;
      const auto from = line.find(R"("what":")") + 8;
      line.replace(from, line.find('"', from) - from, "implausible");
      const auto detail = line.find(R"("detail":")") + 10;
      line.replace(detail, line.find('"', detail) - detail, why);
      all.insert(end, line);
    };
  };
  planted p;
  p.change("events.jsonl", objects_to("others value=0.8 limit=2.5"));
  CHECK(!p.breaks("believed"));
  p.change("events.jsonl", objects_to("place value=1.1 limit=1.0"));
  CHECK(p.breaks("believed"));
}
