// Shards as a cluster starts, stops and kills them.
#include "tests/processes/sweep_runs.hpp"
#include "tests/processes/workplace.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/dice.hpp"

#include <nlohmann/json.hpp>

#include <csignal>
#include <map>
#include <numeric>
#include <utility>

using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

/// Nine runs of three lengths.
constexpr auto nine_runs = R"(name = "gaps"
scenario = "config/ulm_lehr.toml"
seeds = 3

[set]
duration = "60s"

[[axis]]
key = "fleet.0.count"
values = [1, 2, 4]
)";

/// Two scenarios of two seeds and three entrants.
constexpr auto town_of_four = R"(duration = "10s"

[street_grid]
columns = 3
rows = 2

[[fleet]]
count = 4
routes = ["block *"]

[[provider]]
position_m = [100.0, 50.0]
area_radius_m = 400.0

[network]
profile = "paper_sim"

[[service]]
name = "trajectory_planning"
planner = "lane_follow"
)";

using words = std::vector<std::string>;

words joined(words all, const words& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

words nine_runs_into(const std::string& out) {
  return {"sweep", "gaps.toml", "--out", out, "-j", "1"};
}

words towns_into(const std::string& out) {
  return {"bench",
          "small.toml",
          "smaller.toml",
          "--policies",
          "location,never,nearest",
          "--seeds",
          "2",
          "--out",
          out,
          "-j",
          "1"};
}

words shard_words(std::size_t number, std::size_t of) {
  return {"--shard", std::to_string(number) + "/" + std::to_string(of)};
}

/// @returns all files of all runs and tables with what they hold; figures of
/// the wall's clock left out.
std::map<std::string, std::string> all_files_of(const fs::path& out) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator{out}) {
    const auto name = entry.path().lexically_relative(out).string();
    if (!entry.is_regular_file() || name.ends_with("timing.csv")
        || name == "report.html")
      continue;
    auto text = read_file(entry.path());
    if (name.ends_with("summary.json")) {
      auto summary = nlohmann::json::parse(text);
      summary.erase("wall_s");
      summary.erase("timing");
      text = summary.dump();
    }
    all[name] = text;
  }
  return all;
}

void check_equal(const fs::path& one, const fs::path& other) {
  const auto here = all_files_of(one), there = all_files_of(other);
  CHECK(here.size() == there.size());
  for (const auto& [name, text] : here) {
    CAPTURE(name);
    REQUIRE(there.contains(name));
    CHECK((there.at(name) == text));
  }
}

/// @returns 1 to `count` in a random order.
std::vector<std::size_t> one_to_shuffled(std::size_t count, dice& roll) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), 1);
  for (auto k = all.size(); k > 1; --k)
    std::swap(
        all[k - 1],
        all[static_cast<std::size_t>(roll.between(0, static_cast<double>(k)))]);
  return all;
}

struct place_of_nine_runs : workplace {
  place_of_nine_runs() { write("gaps.toml", nine_runs); }
};

struct place_of_towns : workplace {
  place_of_towns() {
    write("small.toml", town_of_four);
    write("smaller.toml",
          std::string{town_of_four} + "[sensors]\nrange_m = 80.0\n");
  }
};

/// @returns whether a run is being made there.
bool makes_a_run(const fs::path& out) {
  std::error_code gone;
  for (fs::recursive_directory_iterator at{out / "runs/.unfinished", gone}, end;
       !gone && at != end; at.increment(gone))
    if (at->path().filename() == "events.jsonl")
      return true;
  return false;
}

} // namespace

TEST_CASE("seven shards in any order, two of them killed and started again, "
          "are merged to the bytes of one sweep") {
  const place_of_nine_runs at;
  REQUIRE(at.run_sofof(nine_runs_into("whole")).code == 0);
  dice roll{3};
  const auto out = at / "out";
  for (const auto number : one_to_shuffled(7, roll)) {
    const auto command = joined(nine_runs_into("out"), shard_words(number, 7));
    if (number == 2 || number == 5) {
      program killed{command, at.here()};
      REQUIRE(wait_until([&] { return makes_a_run(out) || !killed.runs(); }));
      killed.send(SIGKILL);
      CHECK(killed.wait().signal == SIGKILL);
    }
    const auto end = at.run_sofof(command);
    CAPTURE(end.err);
    CHECK(end.code == 0);
    CHECK(contains(end.out, "shard " + std::to_string(number) + " of 7: "));
    CHECK(contains(end.out, "without --shard writes out/gaps.csv"));
    CHECK_FALSE(fs::exists(out / "gaps.csv"));
  }
  CHECK(summaries_in(out) == 9);
  CHECK(fs::is_empty(out / "runs/.unfinished")); // also of those killed
  const auto merged = at.run_sofof(nine_runs_into("out"));
  CHECK(merged.code == 0);
  CHECK(contains(merged.out, "9 good, 0 unsafe, 0 failed"));
  check_equal(at / "whole", out);
}

TEST_CASE("shards and the whole sweep at the same time harm nobody") {
  const place_of_nine_runs at;
  REQUIRE(at.run_sofof(nine_runs_into("whole")).code == 0);
  program one{joined(nine_runs_into("out"), shard_words(1, 2)), at.here()};
  program again{joined(nine_runs_into("out"), shard_words(1, 2)), at.here()};
  program merge{nine_runs_into("out"), at.here()};
  program two{joined(nine_runs_into("out"), shard_words(2, 2)), at.here()};
  for (auto* each : {&one, &again, &merge, &two}) {
    const auto end = each->wait();
    CAPTURE(end.err);
    CHECK(end.code == 0);
    CHECK(end.err == "");
  }
  check_equal(at / "whole", at / "out");
}

TEST_CASE("shards of a bench are merged to the tables of one, and decision "
          "times come from shard 1") {
  const place_of_towns at;
  REQUIRE(at.run_sofof(towns_into("whole")).code == 0);
  for (const std::size_t number : {3, 2, 1}) {
    const auto end =
        at.run_sofof(joined(towns_into("out"), shard_words(number, 3)));
    CAPTURE(end.err);
    CHECK(end.code == 0);
    CHECK(contains(end.out, "writes out/report.html"));
    CHECK_FALSE(fs::exists(at / "out/leaderboard.csv"));
    CHECK_FALSE(fs::exists(at / "out/small.csv"));
    std::size_t timed = 0;
    for (const auto& run : fs::directory_iterator{at / "out/runs"})
      timed += contains(read_file(run.path() / "timing.csv"), "lodm_decisions")
                   ? 1U
                   : 0U;
    CHECK(timed == (number == 1 ? 6 : 0)); // a seed of each
  }
  const auto merged = at.run_sofof(towns_into("out"));
  CAPTURE(merged.err);
  CHECK(merged.code == 0);
  CHECK(summaries_in(at / "out") == 12);
  check_equal(at / "whole", at / "out");
  const auto times = read_file(at / "out/timing.csv");
  for (const auto* timed :
       {"\nsmall,location,lodm,", "\nsmaller,location,lodm,",
        "\nsmall,nearest,lodm,", "\nsmaller,never,lodm,"})
    CHECK(contains(times, timed));
}

TEST_CASE("a shard that there cannot be is refused with one sentence") {
  const place_of_nine_runs at;
  for (const auto* text : {"0/7", "8/7", "a/b", "7", "1/0", "-1/7", "1/7/2"}) {
    CAPTURE(text);
    const auto end = at.run_sofof(
        joined(nine_runs_into("out"), {std::string{"--shard="} + text}));
    CHECK(end.code == 2);
    CHECK(end.err.starts_with(std::string{"sofof: --shard "} + text + ": "));
    CHECK(std::ranges::count(end.err, '\n') == 1);
    CHECK_FALSE(fs::exists(at / "out"));
  }
  // Of a variable that is not set; it must not make all runs.
  const auto empty =
      at.run_sofof(joined(nine_runs_into("out"), {"--shard", ""}));
  CHECK(empty.code == 2);
  CHECK_FALSE(fs::exists(at / "out"));
}

TEST_CASE("how many runs there are to share out is one number") {
  const place_of_nine_runs sweep;
  const auto all = sweep.run_sofof(joined(nine_runs_into("out"), {"--count"}));
  CHECK(all.code == 0);
  CHECK(all.out == "9\n");
  CHECK_FALSE(fs::exists(sweep / "out"));
  const place_of_towns bench;
  CHECK(bench.run_sofof(joined(towns_into("out"), {"--count"})).out == "12\n");
  const auto paper = sweep.run_sofof({"reproduce", "--count"});
  CHECK(paper.code == 0);
  CHECK(std::stoi(paper.out) > 300);
  const auto both = sweep.run_sofof(
      joined(joined(nine_runs_into("out"), shard_words(1, 2)), {"--count"}));
  CHECK(both.code == 2);
  CHECK(contains(both.err, "leave --shard out"));
}
