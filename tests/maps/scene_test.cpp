// What a CommonRoad scenario says beside its lanes.
#include "base/input_error.hpp"
#include "tests/maps/files.hpp"

#include "maps/commonroad_scene.hpp"
#include <numbers>

namespace sofof::maps_tests::scenes {

namespace {

constexpr auto pi = std::numbers::pi;

maps::commonroad_scene scene_of(const std::string& text) {
  return maps::read_commonroad_scene(maps::xml_file{text, "scene.xml"});
}

/// The scene with one text in place of another.
std::string with(std::string_view old, std::string_view instead) {
  auto text = text_of("scene.xml");
  const auto at = text.find(old);
  REQUIRE(at != text.npos);
  return text.replace(at, old.size(), instead);
}

void check_refused(const std::string& text, const char* why) {
  CHECK_THROWS_WITH_AS(scene_of(text), doctest::Contains(why), input_error);
}

} // namespace

TEST_CASE("a scene has its name, obstacles, houses and problems") {
  const auto scene = scene_of(text_of("scene.xml"));
  CHECK(scene.benchmark == "ZAM_Scene-1_1_T-1");
  CHECK(scene.version == "2020a");
  CHECK(scene.step_s == 0.1);
  CHECK(scene.lanelets.size() == 3);
  CHECK(scene.bodies.size() == 3);
  REQUIRE(scene.houses.size() == 1);
  CHECK(scene.houses.front().size() == 3);
  CHECK(scene.problems.size() == 1);
  CHECK(scene.left_out.size() == 1); // the phantom
}

TEST_CASE("a shape has its own place and turn in a body's frame") {
  const auto body = scene_of(text_of("scene.xml")).bodies[0];
  CHECK_FALSE(body.moves);
  CHECK(body.length_m == 4);
  REQUIRE(body.states.size() == 1);
  CHECK(body.states[0].heading_rad == doctest::Approx(0.7));
  CHECK(body.states[0].at.x_m == doctest::Approx(150 + std::cos(0.2)));
  CHECK(body.states[0].at.y_m == doctest::Approx(12 + std::sin(0.2)));
}

TEST_CASE("a trajectory begins with the initial state; what is not exact is "
          "taken in its middle") {
  const auto body = scene_of(text_of("scene.xml")).bodies[1];
  CHECK(body.moves);
  REQUIRE(body.states.size() == 3);
  CHECK(body.states[0].at == point{40, 1.75});
  CHECK(body.states[2].step == 2);
  CHECK(body.states[2].at == point{42, 1.75});
  CHECK(body.states[2].heading_rad == doctest::Approx(0));
  CHECK(body.states[2].speed_mps == doctest::Approx(10));
}

TEST_CASE("occupancies are boxes as large as the largest") {
  const auto body = scene_of(text_of("scene.xml")).bodies[2];
  REQUIRE(body.states.size() == 2);
  CHECK(body.length_m == 3);
  CHECK(body.width_m == 2);
  CHECK(body.states[1].at == point{101.5, 9});
  CHECK(body.states[0].speed_mps == doctest::Approx(15));
}

TEST_CASE("a problem has a start and goals in place, time, speed, heading") {
  const auto problem = scene_of(text_of("scene.xml")).problems[0];
  CHECK(problem.id == "30");
  CHECK(problem.at == point{10, 1.75});
  CHECK(problem.speed_mps == 9);
  REQUIRE(problem.goals.size() == 2);
  const auto& goal = problem.goals[0];
  CHECK(goal.first == 10);
  CHECK(goal.last == 30);
  CHECK(problem.end() == 30);
  CHECK(goal.speed_mps->high == 15);
  CHECK(goal.places.front().contains({20.1, 3.4}));
  CHECK_FALSE(goal.places.front().contains({19.9, 1}));
  CHECK(problem.goals[1].places.front().contains({199, 0.1}));
  CHECK_FALSE(problem.goals[1].places.front().contains({79, 1}));
}

TEST_CASE("angles count without full turns") {
  const maps::closed_interval across{3, 3.5};
  CHECK(across.holds_angle(3.1));
  CHECK(across.holds_angle(-3.1));
  CHECK(across.holds_angle(3.2 + 4 * pi));
  CHECK_FALSE(across.holds_angle(0));
  CHECK_FALSE(across.holds_angle(-2.5));
  CHECK(maps::closed_interval{-10, 10}.holds_angle(1));
}

TEST_CASE("the older version says what an obstacle is by its role") {
  auto text =
      with("commonRoadVersion=\"2020a\"", "commonRoadVersion=\"2018b\"");
  const auto swap = [&text](std::string_view old, std::string_view instead) {
    const auto at = text.find(old);
    REQUIRE(at != text.npos);
    text.replace(at, old.size(), instead);
  };
  swap("<dynamicObstacle id=\"21\">",
       "<obstacle id=\"21\"><role>dynamic</role>");
  swap("</dynamicObstacle>", "</obstacle>");
  swap("<staticObstacle id=\"20\">", "<obstacle id=\"20\"><role>static</role>");
  swap("</staticObstacle>", "</obstacle>");
  const auto scene = scene_of(text);
  CHECK_FALSE(scene.bodies[0].moves);
  CHECK(scene.bodies[1].moves);
}

TEST_CASE("what is wrong in a scene is refused with its place") {
  check_refused(with("\"2020a\"", "\"2031c\""), "\"2031c\" is not known");
  check_refused(with("<time><exact>2</exact></time><velocity><intervalStart>9",
                     "<time><exact>1</exact></time><velocity><intervalStart>9"),
                "time 1 does not come after 1");
  check_refused(with("<lanelet ref=\"2\"/>", "<lanelet ref=\"7\"/>"),
                "there is no lanelet \"7\"");
  check_refused(with("<length>4.5</length>", "<length>51</length>"),
                "50 m are the most");
  check_refused(with("<width>1.8</width></rectangle></shape>\n    "
                     "<initialState><position><point><x>40.0",
                     "<width>x</width></rectangle></shape>\n    "
                     "<initialState><position><point><x>40.0"),
                "scene.xml:25:44: ");
  check_refused(with("<velocity><exact>9.0</exact></velocity>", ""),
                "needs <velocity>");
  check_refused(
      with("<intervalEnd>30</intervalEnd>", "<intervalEnd>3</intervalEnd>"),
      "ends before it begins");
  check_refused(
      with("<point><x>30.0</x><y>-20.0</y></point></polygon>", "</polygon>"),
      "3 to 10000 points");
}

TEST_CASE("a lanelet with a sign to give way comes after the others") {
  const auto map = imported("scene.xml");
  CHECK(lane_of(map, "1").rank == 0);
  CHECK(lane_of(map, "2").rank == 0); // others lead to it, too
  CHECK(lane_of(map, "3").rank == 1);
  CHECK(map.middle.x_m == 100);
}

} // namespace sofof::maps_tests::scenes
