// Ctrl-C, an orderly stop, and a kill, in the middle of a run.
#include "tests/processes/results_reader.hpp"
#include "tests/processes/workplace.hpp"

#include <algorithm>

using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

constexpr double planned_s = 24 * 3600;

/// Starts a run that would take minutes.
std::vector<std::string> long_run() {
  return {"run", scenario_file, "--duration", "24h", "--out", "out"};
}

/// Waits until a run has recorded something of all kinds.
bool is_under_way(program& run, const fs::path& out) {
  return wait_until([&] {
           std::error_code none;
           return !run.runs()
                  || (fs::file_size(out / "episodes.csv", none) > 1000
                      && !none);
         })
         && run.runs();
}

constexpr auto tables = {"episodes.csv", "cycles.csv", "tracks.csv"};

/// A write that is killed ends anywhere: drops what a reader has to drop.
void drop_cut_lines(const fs::path& out) {
  std::vector<fs::path> files{tables.begin(), tables.end()};
  files.emplace_back("events.jsonl");
  for (const auto& name : files)
    fs::resize_file(out / name, read_file(out / name).rfind('\n') + 1);
}

void check_whole_lines(const fs::path& out) {
  for (const auto* name : tables) {
    CAPTURE(name);
    CHECK(ends_with_a_whole_line(out / name));
    rows_of(out / name);
  }
  CHECK(ends_with_a_whole_line(out / "events.jsonl"));
  for (const auto& line : lines_of(out / "events.jsonl"))
    REQUIRE(nlohmann::json::accept(line));
}

} // namespace

TEST_CASE("an interrupted run keeps what it recorded, and says so") {
  for (const int signal : {SIGINT, SIGTERM}) {
    CAPTURE(signal);
    const workplace at;
    const auto out = at / "out";
    program run{long_run(), at.here()};
    REQUIRE(is_under_way(run, out));
    run.send(signal);
    const auto end = run.wait();
    CAPTURE(end.err);
    CHECK(end.code == 130);
    CHECK(end.err == "");
    CHECK(end.out.find("INTERRUPTED") != end.out.npos);

    check_whole_lines(out);
    const auto summary = summary_of(out);
    CHECK(summary["interrupted"] == true);
    const double virtual_s = summary["virtual_s"];
    CHECK(virtual_s > 0);
    CHECK(virtual_s < planned_s);
    const auto tracks = rows_of(out / "tracks.csv");
    CHECK(number(tracks.back(), "t_s") > virtual_s - 0.2);
    CHECK(number(tracks.back(), "t_s") <= virtual_s);

    // Every episode is closed on both sides and counted.
    const auto all = episodes_of(out, "requester", "trajectory_planning");
    CHECK(all.size() == summary["episodes"]);
    CHECK(episodes_of(out, "provider", "trajectory_planning").size()
          == all.size());
    CHECK(summary["running_at_end"] == 0);
    CHECK(rows_of(out / "cycles.csv").size()
          == summary["services"]["trajectory_planning"]["latency_ms"]["count"]
                     .get<std::size_t>()
                 + summary["services"]["cabin_climate"]["latency_ms"]["count"]
                       .get<std::size_t>());
  }
}

TEST_CASE("a run on the wall's clock is interrupted as well") {
  const workplace at;
  const auto out = at / "out";
  auto words = long_run();
  words.emplace_back("--realtime");
  program run{words, at.here()};
  REQUIRE(wait_until([&] { return !lines_of(out / "events.jsonl").empty(); }));
  run.send(SIGINT);
  const auto end = run.wait();
  CHECK(end.code == 130);
  check_whole_lines(out);
  CHECK(summary_of(out)["interrupted"] == true);
}

TEST_CASE("a killed run leaves whole lines up to the last line end, and no "
          "summary") {
  const workplace at;
  const auto out = at / "out";
  program run{long_run(), at.here()};
  REQUIRE(is_under_way(run, out));
  run.send(SIGKILL);
  const auto end = run.wait();
  CHECK(end.signal == SIGKILL);
  CHECK_FALSE(fs::exists(out / "summary.json"));
  CHECK(fs::exists(out / "config.toml"));
  drop_cut_lines(out);
  check_whole_lines(out);
}
