// Runs from outside: on the wall's clock, side by side, and what they print.
#include "tests/processes/results_reader.hpp"
#include "tests/processes/workplace.hpp"
#include "tests/support/files.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

using namespace sofof::test;
namespace fs = std::filesystem;

TEST_CASE("six vehicles drive and offload on the wall's clock") {
  const workplace at;
  const auto out = at.drive("out", {"--realtime", "--duration", "3s"});
  const auto summary = summary_of(out);
  CHECK(summary["virtual_s"] == 3.0);
  CHECK(summary["timing"]["wall_s"] >= 2.99); // rounded, and not from 0
  CHECK(summary["wall_s"] == summary["timing"]["wall_s"]);
  CHECK(summary["interrupted"] == false);
  CHECK(summary["safety"]["collisions"] == 0);
  CHECK(summary["safety"]["without_fresh_plan_s"] == 0.0);
  CHECK(summary["safety"]["off_road_s"] == 0.0);
  CHECK(summary["episodes"] >= 1); // 102 starts in the area
  CHECK(rows_of(out / "cycles.csv").size() > 20);
}

TEST_CASE(
    "a run on the wall's clock says when the machine let it stand still") {
  constexpr double stopped_s = 0.6;
  const workplace at;
  program run{
      {"run", scenario_file, "--realtime", "--duration", "3s", "--out", "out"},
      at.here()};
  REQUIRE(wait_until([&] { // until it has begun to drive
    std::error_code not_yet;
    const auto octets = fs::file_size(at / "out/tracks.csv", not_yet);
    return !not_yet && octets > 0;
  }));
  run.send(SIGSTOP);
  std::this_thread::sleep_for(std::chrono::duration<double>{stopped_s});
  run.send(SIGCONT);
  const auto end = run.wait();
  CAPTURE(end.out);
  std::string said = end.out;
  std::ranges::replace(said, '\n', ' ');
  CHECK(said.find("The machine kept a thread waiting") != said.npos);
  const double seen_s = summary_of(at / "out")["timing"]["stood_still_s"];
  CHECK(seen_s >= stopped_s - 0.05);
  CHECK(seen_s < 3);
}

TEST_CASE("runs without a folder of their own take the first free one") {
  const workplace at;
  const std::vector<std::string> words{"run",        scenario_file, "--quiet",
                                       "--duration", "1s",          "--seed"};
  for (const std::string seed : {"5", "5", "5", "6"}) {
    auto all = words;
    all.push_back(seed);
    CHECK(at.run_sofof(all).code == 0);
  }
  for (const auto* name :
       {"ulm_lehr-5", "ulm_lehr-5-2", "ulm_lehr-5-3", "ulm_lehr-6"}) {
    CAPTURE(name);
    CHECK(fs::exists(at / "results" / name / "summary.json"));
  }
  CHECK(summary_of(at / "results/ulm_lehr-6")["seed"] == 6);
  CHECK_FALSE(fs::exists(at / "results/ulm_lehr-6-2"));
}

TEST_CASE("a run ends with a table and where its results are") {
  const workplace at;
  const auto end =
      at.run_sofof({"run", scenario_file, "--duration", "60s", "--out", "out"});
  CHECK(end.code == 0);
  CHECK(end.err == "");
  for (const auto* words : {"trajectory_planning", "cabin_climate", "latency",
                            "collisions", "results in /", "/out\n"}) {
    CAPTURE(words);
    CHECK(end.out.find(words) != end.out.npos);
  }
  CHECK(end.out.find('\x1b') == end.out.npos); // no terminal, no colours
}

TEST_CASE("records that are not wanted are not written") {
  const workplace at;
  const auto out =
      at.drive("out", {"--duration", "5s", "--set", "record.cycles=false",
                       "--set", "record.tracks=false"});
  CHECK_FALSE(fs::exists(out / "cycles.csv"));
  CHECK_FALSE(fs::exists(out / "tracks.csv"));
  CHECK(summary_of(out)["latency_ms"]["count"] > 50);
}

TEST_CASE("on any number of threads a run writes the same; on the wall clock "
          "their number is not for the user to say") {
  const workplace at;
  const auto one = at.drive("one", {"--threads", "1", "--duration", "20s"});
  const auto four = at.drive("four", {"--threads", "4", "--duration", "20s"});
  for (const auto* file : {"cycles.csv", "tracks.csv", "events.jsonl"}) {
    CAPTURE(file);
    CHECK(!read_file(one / file).empty());
    CHECK((read_file(one / file) == read_file(four / file)));
  }
  const auto end =
      at.run_sofof({"run", scenario_file, "--realtime", "--threads", "4"});
  CHECK(end.code == 2);
  CHECK(end.err.find("--threads is of virtual time") != end.err.npos);
}
