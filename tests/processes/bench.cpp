// Policies ranked, as their users start, stop and misspell it.
#include "tests/processes/sweep_runs.hpp"
#include "tests/processes/workplace.hpp"
#include "tests/support/contains.hpp"

#include <csignal>
#include <sstream>

using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

/// Four cars round two blocks, for ten seconds.
constexpr auto small_town = R"(duration = "10s"

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

const std::vector<std::string> outputs{"leaderboard.csv", "small.csv",
                                       "smaller.csv"};

void write_towns(const workplace& at) {
  at.write("small.toml", small_town);
  at.write("smaller.toml",
           std::string{small_town} + "[sensors]\nrange_m = 80.0\n");
}

std::vector<std::string> bench_into(const std::string& out,
                                    const std::string& jobs = "2") {
  return {"bench",
          "small.toml",
          "smaller.toml",
          "--policies",
          "location,never,spread_by_deadlines",
          "--seeds",
          "2",
          "--out",
          out,
          "-j",
          jobs};
}

} // namespace

TEST_CASE("policies are ranked in all scenarios, the same table again and "
          "again") {
  const workplace at;
  write_towns(at);
  for (const auto* jobs : {"1", "3"}) {
    const auto end = at.run_sofof(bench_into(jobs, jobs));
    CAPTURE(end.err);
    CAPTURE(end.out);
    REQUIRE(end.code == 0);
    CHECK(contains(end.out, "policy"));
    CHECK(contains(end.out, "\nspread_by_deadlines "));
    CHECK(contains(end.out, std::string{"report in "} + jobs + "/report.html"));
    CHECK(summaries_in(at / jobs) == 12);
  }
  for (const auto& file : outputs) {
    CAPTURE(file);
    CHECK((read_file(at / "1" / file) == read_file(at / "3" / file)));
  }
  std::istringstream board{read_file(at / "1/leaderboard.csv")};
  std::vector<std::string> lines;
  for (std::string line; std::getline(board, line);)
    lines.push_back(line);
  REQUIRE(lines.size() == 10); // three entrants in two scenarios, and in all
  CHECK(lines[1].starts_with("all,1,"));
  CHECK(lines[4].starts_with("small,1,"));
  CHECK(lines[7].starts_with("smaller,1,"));
  const auto times = read_file(at / "1/timing.csv");
  CHECK(contains(times, "\nsmall,location,lodm,"));
  CHECK(contains(times, "\nsmaller,spread_by_deadlines,codm,"));
  CHECK_FALSE(contains(times, "never,codm")); // nobody asks
  CHECK(contains(read_file(at / "1/report.html"), "Who offloads best"));
}

TEST_CASE("a bench that is killed goes on to the same table") {
  const workplace at;
  write_towns(at);
  REQUIRE(at.run_sofof(bench_into("whole")).code == 0);
  program killed{bench_into("killed", "1"), at.here()};
  REQUIRE(wait_until([&] { return summaries_in(at / "killed") >= 2; }));
  killed.send(SIGKILL);
  killed.wait();
  CHECK_FALSE(fs::exists(at / "killed/leaderboard.csv"));
  program interrupted{bench_into("killed", "1"), at.here()};
  REQUIRE(wait_until([&] { return summaries_in(at / "killed") >= 4; }));
  interrupted.send(SIGINT);
  CHECK(interrupted.wait().code == 130);
  REQUIRE(at.run_sofof(bench_into("killed")).code == 0);
  for (const auto& file : outputs)
    CHECK((read_file(at / "killed" / file) == read_file(at / "whole" / file)));
}

TEST_CASE("the same runs serve a ranking of others") {
  const workplace at;
  write_towns(at);
  REQUIRE(at.run_sofof(bench_into("out")).code == 0);
  const auto before = summaries_in(at / "out");
  const auto end =
      at.run_sofof({"bench", "small.toml", "--policies", "never,location",
                    "--seeds", "1", "--out", "out"});
  CHECK(end.code == 0);
  CHECK(summaries_in(at / "out") == before);
}

TEST_CASE("a scenario's own policies are ranked with the others") {
  const workplace at;
  at.write("mine.toml",
           std::string{small_town}
               + "[policies]\n"
                 "codm = { name = \"drift_plus_penalty\", V = 7.0 }\n");
  const auto end =
      at.run_sofof({"bench", "mine.toml", "--policies", "location,mine.toml",
                    "--seeds", "1", "--out", "out"});
  CAPTURE(end.err);
  REQUIRE(end.code == 0);
  CHECK(contains(end.out, "\nmine.toml "));
  CHECK(contains(read_file(at / "out/leaderboard.csv"), "V = 7.0"));
}

TEST_CASE("a bench writes into no folder of something else") {
  const workplace at;
  write_towns(at);
  fs::create_directory(at / "run");
  at.write("run/timing.csv", "figure,value\n");
  const auto end = at.run_sofof({"bench", "small.toml", "--out", "run"});
  CHECK(end.code == 2);
  CHECK(contains(end.err, "something else than a bench"));
  CHECK(contains(end.err, "--out"));
  CHECK(read_file(at / "run/timing.csv") == "figure,value\n");
}

TEST_CASE("who wants all, where the usual entrants are missing, is told so") {
  const workplace at;
  write_towns(at);
  fs::create_directory(at / "run");
  at.write("run/timing.csv", "figure,value\n"); // so that nothing runs
  const auto told = [&at](const std::string& policies) {
    const auto end = at.run_sofof(
        {"bench", "small.toml", "--policies", policies, "--out", "run"});
    return contains(end.err, "there is no config/policies.toml here");
  };
  CHECK_FALSE(told("all"));
  fs::remove(at / "config/policies.toml");
  CHECK(told("all"));
  CHECK_FALSE(told("location"));
}

TEST_CASE("what cannot be ranked is refused before anything runs") {
  const workplace at;
  write_towns(at);
  at.write("mine.toml", "x = { lodm = \"nearst\" }\n");
  fs::create_directory(at / "other");
  fs::copy(at / "small.toml", at / "other/small.toml");
  const auto refused = [&at](std::vector<std::string> words,
                             std::string_view why) {
    words.insert(words.begin(), "bench");
    words.insert(words.end(), {"--out", "out"});
    CAPTURE(words);
    const auto end = at.run_sofof(words);
    CHECK(end.code == 2);
    CAPTURE(end.err);
    CHECK(contains(end.err, why));
    CHECK_FALSE(fs::exists(at / "out"));
  };
  refused({"small.toml", "--policies", "nearst"}, "did you mean \"nearest\"?");
  refused({"no_such.toml"},
          "no_such.toml: this file cannot be read: No such file or directory.");
  refused({"small.toml", "other/small.toml"},
          "other/small.toml: the name \"small\" is taken");
  refused({"small.toml", "--entrants", "mine.toml"}, "mine.toml:1:14: ");
  refused({"small.toml", "--entrants", "none.toml"}, "none.toml: ");
  refused({"small.toml", "--seeds", "0"}, "--seeds");
  refused({"small.toml", "--set", "policies.lodm=never"},
          "each entrant sets the policies itself");
}
