// Drives in scenarios of CommonRoad, and what is said of them.
#include "experiments/judge/judged_table.hpp"
#include "tests/judge/made_scene.hpp"
#include "tests/support/contains.hpp"

namespace sofof::judging {

using namespace experiments::judge;
using test::contains;

TEST_CASE("a goal ahead on an empty road is reached, and solved") {
  const judged_scene made{made_scene{}.text()};
  const auto& row = made.only();
  CHECK(row.found.what == outcome::reached);
  CHECK(row.limit.empty());
  CHECK(row.found.at_s > 3); // 45 m at 10 m/s to 13.9 m/s
  CHECK(row.found.at_s < 5);
  CHECK(row.way_m == doctest::Approx(45).epsilon(0.05));
  const auto solution = made.text_of(row.solution);
  CHECK(contains(solution, "benchmark_id=\"KS2:SM1:ZAM_Made-1_1_T-1:2020a\""));
  CHECK(contains(solution, "<ksTrajectory planningProblem=\"7\">"));
  CHECK(contains(solution, "<x>30.000000</x>")); // in the file's frame
  CHECK(contains(made.text_of("made.toml"), "map = \"made_map.toml\""));
}

TEST_CASE("a drive is the same bytes again") {
  const auto text = made_scene{}.text();
  const judged_scene one{text}, other{text};
  for (const auto* name :
       {"made.toml", "made_map.toml", "solution_KS2_SM1_made.xml"})
    CHECK(one.text_of(name) == other.text_of(name));
}

TEST_CASE("who would be too early drives slower") {
  const judged_scene made{made_scene{.first = 100, .last = 110}.text()};
  CHECK(made.only().found.what == outcome::reached);
  CHECK(made.only().found.at_s == doctest::Approx(10).epsilon(0.1));
}

TEST_CASE("who comes too late is late") {
  const judged_scene made{made_scene{.last = 20}.text()};
  CHECK(made.only().found.what == outcome::late);
  CHECK(contains(made.only().found.why, "asked 0.0 s to 2.0 s"));
  CHECK(made.only().solution.empty());
}

TEST_CASE("a goal asks for a speed and a heading") {
  made_scene slow;
  slow.more_of_goal = "<velocity><intervalStart>2</intervalStart><intervalEnd>"
                      "5</intervalEnd></velocity>";
  slow.last = 100;
  CHECK(judged_scene{slow.text()}.only().found.what == outcome::reached);
  made_scene turned;
  turned.more_of_goal = "<orientation><intervalStart>1</intervalStart>"
                        "<intervalEnd>2</intervalEnd></orientation>";
  const judged_scene made{turned.text()};
  CHECK(made.only().found.what == outcome::late);
  CHECK(contains(made.only().found.why, "1.00 rad to 2.00 rad"));
}

TEST_CASE("a goal without a place is anywhere") {
  auto text = made_scene{}.text();
  const auto from = text.find("<goalState><position>") + 11;
  text.erase(from, text.find("</position>\n<time>") + 11 - from);
  CHECK(judged_scene{text}.only().found.what == outcome::reached);
}

TEST_CASE("nobody changes lanes") {
  const judged_scene made{made_scene{.goal_y_m = 3.5}.text()};
  CHECK(made.only().found.what == outcome::no_route);
  CHECK(contains(made.only().found.why, "without a lane change"));
}

TEST_CASE("a start or goal off the lanes has no route") {
  const judged_scene goal{made_scene{.goal_y_m = 30}.text()};
  CHECK(contains(goal.only().found.why, "no lane leads through"));
  const judged_scene start{made_scene{.start_y_m = -30}.text()};
  CHECK(contains(start.only().found.why, "the start is on no lane"));
}

TEST_CASE("a goal behind the file's last lane is driven to all the same") {
  const judged_scene made{made_scene{.start_x_m = 350, .goal_x_m = 394}.text()};
  CHECK(made.only().found.what == outcome::reached);
}

TEST_CASE("who begins beside the road is off it") {
  const judged_scene made{made_scene{.start_y_m = -1.5}.text()};
  CHECK(made.only().found.what == outcome::off_road);
  CHECK(made.only().found.at_s == 0);
  const judged_scene near{made_scene{.start_y_m = -0.9}.text()};
  CHECK(near.only().found.what == outcome::reached);
}

TEST_CASE("a slower car ahead is followed") {
  made_scene slow{.last = 190, .goal_x_m = 100};
  slow.add_driver(55, 0, 5);
  CHECK(judged_scene{slow.text()}.only().found.what == outcome::reached);
}

TEST_CASE("who is run into from behind is not at fault") {
  made_scene fast{.last = 150, .goal_x_m = 200};
  fast.add_driver(2, 0, 30);
  const judged_scene made{fast.text()};
  CHECK(made.only().found.what == outcome::collided);
  CHECK_FALSE(made.only().found.own_fault);
  CHECK(contains(made.only().found.why, "with obstacle 50 from behind"));
}

TEST_CASE("whoever else is touched, it is the own fault") {
  made_scene sudden{.last = 150, .goal_x_m = 200};
  sudden.add_driver(75, 0, 0, 30); // there from 3 s on
  const judged_scene made{sudden.text()};
  CHECK(made.only().found.what == outcome::collided);
  CHECK(made.only().found.own_fault);
  CHECK(judged_counts{made.rows}.own_fault == 1);
}

TEST_CASE("a file that is wrong is a row with its place, and writes nothing") {
  auto text = made_scene{}.text();
  text.replace(text.find("<x>80</x>"), 9, "<x>8O</x>");
  const judged_scene made{text};
  CHECK(made.only().found.what == outcome::refused);
  CHECK(contains(made.only().found.why, "made.xml:"));
  CHECK(made.names() == std::vector<std::string>{"made.xml"});
}

TEST_CASE("each planning problem of a file is driven by itself") {
  auto text = made_scene{}.text();
  const auto begin = text.find("<planningProblem");
  const auto end = text.find("</commonRoad>");
  auto second = text.substr(begin, end - begin);
  second.replace(second.find("\"7\""), 3, "\"8\"");
  text.insert(end, second);
  const judged_scene made{text};
  REQUIRE(made.rows.size() == 2);
  CHECK(made.rows[1].problem == "8");
  CHECK(made.rows[1].found.what == outcome::reached);
  CHECK(made.rows[1].solution.empty()); // of several cars none is written
}

TEST_CASE("a table counts the results and says why") {
  std::vector<judged> rows(3);
  rows[0].scenario = "A";
  rows[0].found.what = outcome::reached;
  rows[1].scenario = "B,C";
  rows[1].found = {outcome::collided, true, 2.5, "at 3.0 m/s", 0};
  rows[2].found = {.what = outcome::no_route, .why = "there is none."};
  CHECK(contains(summary(rows), "3 planning problems: 1 reached (33.3 %), 1 "
                                "collided (33.3 %), 1 no route (33.3 %)"));
  CHECK(contains(summary(rows), "by own fault: 1\n"));
  const auto csv = to_csv(rows);
  CHECK(contains(csv, ",\"B,C\",,collided,1,2.500,0.000,,,at 3.0 m/s\n"));
  CHECK(contains(table_line(rows[2]), "no route           there is none.\n"));
  const auto page = judged_page(rows);
  CHECK(page.sections.size() == 2);
}

} // namespace sofof::judging
