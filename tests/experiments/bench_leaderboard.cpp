// Who is ranked where, and how it is shown.
#include "base/input_error.hpp"
#include "experiments/benchmark/board_page.hpp"
#include "experiments/benchmark/board_text.hpp"
#include "experiments/benchmark/decision_costs.hpp"
#include "experiments/benchmark/leaderboard.hpp"
#include "experiments/report/documented.hpp"
#include "tests/support/near.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace sofof::experiments::bench {

using test::near;
using test::scratch;

namespace {

const std::vector<entrant> three{
    {"slow", "a", "x"}, {"good", "b", "x"}, {"wild", "{ name = \"c\" }", "x"}};
const expected_runs two_by_two{{"slow", "good", "wild"}, {"east", "west"}, 2};

judged_run run(const char* who, const char* where, std::int64_t seed,
               double score, double violations, double saved) {
  return {who,
          where,
          seed,
          true,
          {{score_name, score},
           {"violations_per_h", violations},
           {"energy_saved_percent", saved}}};
}

/// "wild" has the best score and one unsafe run; "slow" never saves anything.
std::vector<judged_run> all_runs() {
  std::vector<judged_run> all;
  for (const auto seed : {1, 2})
    for (const auto* where : {"east", "west"}) {
      const auto noise = 0.01 * static_cast<double>(seed);
      all.push_back(run("slow", where, seed, 0.4 + noise, 0, 0));
      all.push_back(run("good", where, seed, 0.2 + noise, 5, 40));
      all.push_back(run("wild", where, seed, 0.1 + noise, 90, 60));
    }
  all[2].safe = false; // wild, east, seed 1
  return all;
}

std::vector<std::string> order_of(const leaderboard& board) {
  std::vector<std::string> names;
  for (const auto& one : board.standings)
    names.push_back(one.entrant);
  return names;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in{text};
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);)
    all.push_back(line);
  return all;
}

} // namespace

TEST_CASE("the lowest score wins, but who was unsafe is below the line") {
  const auto east = rank(all_runs(), two_by_two, "east");
  CHECK(order_of(east) == std::vector<std::string>{"good", "slow", "wild"});
  CHECK(east.above().size() == 2);
  REQUIRE(east.below().size() == 1);
  CHECK(east.below()[0].unsafe == 1);
  const auto west = rank(all_runs(), two_by_two, "west");
  CHECK(order_of(west) == std::vector<std::string>{"wild", "good", "slow"});
  CHECK(west.below().empty());
  CHECK(rank(all_runs(), two_by_two, "").below().size() == 1);
}

TEST_CASE("who lacks a run is below the line") {
  auto runs = all_runs();
  std::erase_if(runs, [](const auto& one) {
    return one.entrant == "good" && one.scenario == "east" && one.seed == 2;
  });
  const auto all = rank(runs, two_by_two, "");
  const auto good =
      std::ranges::find(all.standings, "good", &standing::entrant);
  CHECK(good->failed == 1);
  CHECK(good->runs == 3);
  CHECK_FALSE(good->above_line());
  const auto none = rank({}, two_by_two, "");
  CHECK(none.standings.size() == 3);
  CHECK(none.above().empty());
}

TEST_CASE("figures are means of all runs, uncertain by their seeds") {
  const auto all = rank(all_runs(), two_by_two, "");
  const auto& score = all.standings[0].values.at(score_name);
  CHECK(score.mean == near(0.215, 1e-12));
  // Two seeds, 0.21 and 0.22: nearly all of the weight may be on either.
  CHECK(score.low == near(0.21, 1e-3));
  CHECK(score.high == near(0.22, 1e-3));
}

TEST_CASE("the same runs give the same table") {
  const std::vector boards{rank(all_runs(), two_by_two, ""),
                           rank(all_runs(), two_by_two, "east")};
  const auto text = to_csv(boards, three);
  CHECK(text == to_csv(boards, three));
  const auto lines = lines_of(text);
  REQUIRE(lines.size() == 7);
  CHECK(lines[0].starts_with("scenario,place,entrant,lodm,codm,status,runs,"
                             "unsafe,failed,tied,offloaded_percent,"
                             "offloaded_percent_low,offloaded_percent_high,"));
  CHECK(lines[0].ends_with(",score,score_low,score_high"));
  CHECK(lines[1].starts_with("all,1,good,b,x,ranked,4,0,0,0,,,,5.000000,"));
  const auto& score = boards[0].standings[0].values.at(score_name);
  CHECK(lines[1].ends_with(
      fmt::format(",0.215000,{:.6f},{:.6f}", score.low, score.high)));
  CHECK(lines[6].starts_with("east,3,wild,\"{ name = \"\"c\"\" }\",x,"));
  CHECK(lines[6].find(",below the line,2,1,0,0,") != std::string::npos);
}

TEST_CASE("a table on a console lines up, with the unranked below a line") {
  const std::vector<decision_cost> costs{
      {"good", "east", "lodm", 10, 1, 1, 2.5, 9},
      {"good", "west", "codm", 10, 1, 2, 4.5, 9}};
  const auto lines =
      lines_of(board_text(rank(all_runs(), two_by_two, ""), costs, false));
  REQUIRE(lines.size() == 5);
  CHECK(lines[0] == "policy  viol/h  saved %  decide us   score");
  CHECK(lines[1] == "good      5.00     40.0        2.0  0.2150");
  CHECK(lines[2] == "slow      0.00      0.0          -  0.4150");
  CHECK(lines[3] == std::string(lines[0].size(), '-'));
  CHECK(lines[4] == "wild     90.00     60.0          -  0.1150");
}

TEST_CASE("on a terminal the best of each column is bold, of those ranked") {
  const auto text = board_text(rank(all_runs(), two_by_two, ""), {}, true);
  const auto bold = [&text](const char* cell) {
    return text.find(std::string{"\x1b[1m"} + cell + "\x1b[0m") != text.npos;
  };
  CHECK(bold("    0.00"));  // violations
  CHECK(bold("     40.0")); // energy
  CHECK(bold("  0.2150"));  // score
  CHECK_FALSE(bold("  0.1150"));
  CHECK_FALSE(bold("     60.0"));
}

TEST_CASE("where all are alike nobody is best") {
  auto runs = all_runs();
  for (auto& one : runs)
    one.values["violations_per_h"] = 3;
  const auto all = rank(runs, two_by_two, "");
  const auto by =
      std::ranges::find(criteria(), "violations_per_h", &criterion::name);
  CHECK(best_of(all, *by) == nullptr);
  CHECK(best_of(rank({}, two_by_two, ""), *by) == nullptr);
}

TEST_CASE("who offloads next to nothing is best in nothing but the score") {
  auto runs = all_runs();
  for (auto& one : runs) {
    one.values["offloaded_percent"] = one.entrant == "slow" ? 0.5 : 40;
    one.values["rejected_percent"] = one.entrant == "slow" ? 100 : 0;
    one.safe = true;
  }
  const auto all = rank(runs, two_by_two, "");
  const auto by =
      std::ranges::find(criteria(), "violations_per_h", &criterion::name);
  CHECK(best_of(all, *by)->mean == 5);
  CHECK(lines_of(board_text(all, {}, false)).back()
        == "slow offloads nothing: 100 % of its requests are refused.");
}

TEST_CASE("of one seed there is no interval") {
  auto runs = all_runs();
  std::erase_if(runs, [](const auto& one) { return one.seed == 2; });
  const expected_runs once{{"slow", "good", "wild"}, {"east", "west"}, 1};
  const std::vector boards{rank(runs, once, "west"), rank(runs, once, "west")};
  const auto page = board_page(boards, {}, three, "one seed");
  const auto& ranking = std::get<report::table>(page.sections[1].blocks[0]);
  CHECK(ranking.rows[0][2] == "0.1100");
  CHECK(ranking.rows[0][3] == "–");
  CHECK(lines_of(to_csv(boards, three))[1].ends_with(",0.110000,,"));
}

TEST_CASE("each column of a leaderboard says what it means") {
  const std::vector boards{rank(all_runs(), two_by_two, "")};
  for (const auto& section : board_page(boards, {}, three, "").sections)
    for (const auto& block : section.blocks)
      if (const auto* t = std::get_if<report::table>(&block)) {
        REQUIRE(t->column_meanings.size() == t->columns.size());
        for (std::size_t i = 0; i < t->columns.size(); ++i) {
          CAPTURE(t->columns[i]);
          CHECK(t->column_meanings[i] != "");
        }
      }
  for (const auto& by : criteria()) {
    CAPTURE(by.name);
    CHECK(report::documented_in(report::bench_page, "What is measured", by.name)
          != "");
  }
}

TEST_CASE("scores whose difference may be none are tied") {
  auto runs = all_runs();
  for (auto& one : runs) {
    one.safe = true;
    // Better with one seed, worse with the other.
    if (one.entrant == "slow")
      one.values[score_name] = one.seed == 1 ? 0.205 : 0.235;
  }
  const auto all = rank(runs, two_by_two, "");
  CHECK(order_of(all) == std::vector<std::string>{"wild", "good", "slow"});
  CHECK_FALSE(all.standings[0].tied);
  CHECK_FALSE(all.standings[1].tied);
  CHECK(all.standings[2].tied);
  const auto page = board_page(std::vector{all}, {}, three, "");
  const auto& ranking = std::get<report::table>(page.sections[0].blocks[1]);
  CHECK(ranking.rows[1][0] == "2");
  CHECK(ranking.rows[2][0] == "3 =");
}

TEST_CASE("nobody on the front is beaten in both, everybody else is") {
  const double x[] = {5, 0, 3, 3, 9, 0, 7}, y[] = {40, 0, 20, 30, 40, 0, 50};
  CHECK(pareto_front(x, y) == std::vector<std::size_t>{1, 3, 0, 6});
  CHECK(pareto_front({}, {}).empty());
}

TEST_CASE("a page has a section for all, one for each scenario, and who "
          "took part") {
  const std::vector boards{rank(all_runs(), two_by_two, ""),
                           rank(all_runs(), two_by_two, "east"),
                           rank(all_runs(), two_by_two, "west")};
  const auto page = board_page(boards, {}, three, "two seeds");
  REQUIRE(page.sections.size() == 4);
  CHECK(page.sections[1].title == "east");
  CHECK(page.sections[2].title == "west");
  const auto& blocks = page.sections[1].blocks;
  REQUIRE(blocks.size() == 4);
  const auto& ranking = std::get<report::table>(blocks[0]);
  REQUIRE(ranking.rows.size() == 2);
  CHECK(ranking.rows[0][1] == "good");
  CHECK(ranking.rows[0].size() == ranking.columns.size());
  const auto& below = std::get<report::table>(blocks[1]);
  CHECK(below.rows[0][0] == "wild");
  CHECK(below.rows[0].size() == below.columns.size());
  const auto& plane = std::get<report::scatter>(blocks[2]);
  REQUIRE(plane.dots.size() == 3);
  CHECK(plane.dots[2].hollow);
  CHECK(plane.joined == std::vector<std::size_t>{1, 0}); // slow, then good
  const auto& others = std::get<report::table>(blocks[3]);
  CHECK(others.rows.size() == 2);
  CHECK(others.rows[0].size() == others.columns.size());
  CHECK(page.sections[2].blocks.size() == 3); // all safe there
}

TEST_CASE("decision times are pooled over runs, side by side") {
  const scratch dir;
  const auto timing = [&dir](const char* name, const char* text) {
    std::filesystem::create_directories(dir / name);
    std::ofstream{dir / name / "timing.csv"} << "figure,value\nwall_s,1\n"
                                             << text;
    return dir / name;
  };
  const auto first = timing("1", "lodm_decisions,10\nlodm_decide_mean_us,1\n"
                                 "lodm_decide_p50_us,1\nlodm_decide_p99_us,3\n"
                                 "lodm_decide_max_us,4\n");
  const auto second =
      timing("2", "x_real_time,\nlodm_decisions,30\nlodm_decide_mean_us,2\n"
                  "lodm_decide_p50_us,2\nlodm_decide_p99_us,5\n"
                  "lodm_decide_max_us,90\n");
  const auto third = timing("3", "");
  const std::vector<timed_runs> runs{{"good", "east", {first, second, third}},
                                     {"slow", "east", {third}}};
  const auto costs = read_decision_costs(runs);
  REQUIRE(costs.size() == 1); // the other side never decided
  CHECK(costs[0].side == "lodm");
  CHECK(costs[0].decisions == 40);
  CHECK(costs[0].mean_us == near(70 / 40., 1e-12));
  CHECK(costs[0].p50_us == 1.5);
  CHECK_FALSE(costs[0].p99_us); // of 10 and 30 decisions
  CHECK(costs[0].max_us == 90);
  CHECK(slowest_p50_us(costs, "good", "") == 1.5);
  CHECK_FALSE(slowest_p50_us(costs, "good", "west"));
  CHECK_FALSE(slowest_p50_us(costs, "slow", ""));
  CHECK_FALSE(slowest_p99_us(costs, "good", ""));
  CHECK(to_csv(costs)
        == "scenario,entrant,side,decisions,mean_us,p50_us,p99_us,max_us\n"
           "east,good,lodm,40,1.8,1.5,,90.0\n");
  const auto many = [&timing](const char* name, const char* p99) {
    return timing(name, ("lodm_decisions,1000\nlodm_decide_mean_us,1\n"
                         "lodm_decide_p50_us,1\nlodm_decide_p99_us,"
                         + std::string{p99} + "\nlodm_decide_max_us,9000\n")
                            .c_str());
  };
  const std::vector<timed_runs> enough{
      {"good", "east", {many("5", "7"), many("6", "14388.8"), first}}};
  CHECK(slowest_p99_us(read_decision_costs(enough), "good", "") == 7);
  const std::vector<timed_runs> gone{{"good", "east", {dir / "4"}}};
  CHECK_THROWS_AS(read_decision_costs(gone), input_error);
}

} // namespace sofof::experiments::bench
