// Sweeps as their users start, stop and kill them.
#include "tests/processes/sweep_runs.hpp"
#include "tests/processes/workplace.hpp"
#include "tests/support/dice.hpp"

#include <chrono>
#include <csignal>
#include <thread>

using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

/// Six short runs.
constexpr auto sweep_without_tracks = R"(name = "gaps"
scenario = "config/ulm_lehr.toml"
seeds = [1, 2]

[set]
duration = "60s"
fleet.0.count = 2
record.tracks = false

[[axis]]
name = "gap"
key = "service.trajectory_planning.max_interarrival"
values = ["60ms", "80ms", "100ms"]
)";

std::vector<std::string> sweep_into(const std::string& out,
                                    const std::string& jobs = "2") {
  return {"sweep", "gaps.toml", "--out", out, "-j", jobs};
}

} // namespace

TEST_CASE("a sweep gives the same table whatever the number of threads") {
  const workplace at;
  at.write("gaps.toml", sweep_without_tracks);
  for (const auto* jobs : {"1", "2", "5"}) {
    const auto end = at.run_sofof(sweep_into(jobs, jobs));
    CAPTURE(end.err);
    CHECK(end.code == 0);
    CHECK(end.out.find("6 good, 0 unsafe, 0 failed") != end.out.npos);
  }
  const auto table = read_file(at / "1/gaps.csv");
  CHECK(std::ranges::count(table, '\n') == 7);
  CHECK((read_file(at / "2/gaps.csv") == table));
  CHECK((read_file(at / "5/gaps.csv") == table));
}

TEST_CASE("a sweep that is killed again and again ends with the same table") {
  const workplace at;
  at.write("gaps.toml", sweep_without_tracks);
  REQUIRE(at.run_sofof(sweep_into("whole")).code == 0);
  dice roll{7};
  for (std::size_t finished = 0; finished < 5; ++finished) {
    program killed{sweep_into("killed", "1"), at.here()};
    REQUIRE(wait_until([&] {
      return fs::exists(at / "killed/runs")
             && summaries_in(at / "killed") >= finished;
    }));
    std::this_thread::sleep_for(
        std::chrono::milliseconds{static_cast<int>(roll.between(0, 40))});
    killed.send(SIGKILL);
    killed.wait();
  }
  CHECK(summaries_in(at / "killed") >= 4);
  REQUIRE(at.run_sofof(sweep_into("killed")).code == 0);
  CHECK(
      (read_file(at / "killed/gaps.csv") == read_file(at / "whole/gaps.csv")));
}

TEST_CASE("an interrupted sweep says so, and goes on later") {
  const workplace at;
  at.write("gaps.toml", sweep_without_tracks);
  program first{sweep_into("out", "1"), at.here()};
  REQUIRE(wait_until([&] { return summaries_in(at / "out") > 0; }));
  first.send(SIGINT);
  const auto end = first.wait();
  CHECK(end.code == 130);
  CHECK(end.out.find("goes on from here") != end.out.npos);
  CHECK_FALSE(fs::exists(at / "out/gaps.csv"));
  CHECK(at.run_sofof(sweep_into("out")).code == 0);
}

TEST_CASE("two sweeps into one folder: the second is refused") {
  const workplace at;
  at.write("gaps.toml", sweep_without_tracks);
  program first{sweep_into("out", "1"), at.here()};
  REQUIRE(wait_until([&] { return fs::exists(at / "out/runs/.lock"); }));
  const auto second = at.run_sofof(sweep_into("out"));
  CHECK(second.code == 2);
  CHECK(second.err.find("another sweep is at work there") != second.err.npos);
}

TEST_CASE("a sweep with a point that cannot be loaded exits with 1") {
  const workplace at;
  auto text = std::string{sweep_without_tracks};
  text.replace(text.find("\"60ms\""), 6, "\"soon\"");
  at.write("gaps.toml", text);
  const auto end = at.run_sofof(sweep_into("out"));
  CHECK(end.code == 1);
  CHECK(end.out.find("4 good, 0 unsafe, 2 failed") != end.out.npos);
  CHECK(end.out.find("point 1 (gap=soon, seed=1) failed") != end.out.npos);
}

TEST_CASE("a wrong sweep file exits with 2 and one sentence") {
  const workplace at;
  at.write("gaps.toml", "name = 5\n");
  const auto end = at.run_sofof(sweep_into("out"));
  CHECK(end.code == 2);
  CHECK(end.err.starts_with("sofof: gaps.toml:1:8: name must be a text."));
  CHECK_FALSE(fs::exists(at / "out"));
}
