// Tests of the judge of scenes: what it refuses, what it makes more cautious,
// and what it must not refuse.
#include "planners/judges/scene_judge.hpp"

#include "planners/trajectory/maneuver_candidates.hpp"
#include "tests/planners/told_drive_of_scenes.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

constexpr auto forever = std::numeric_limits<double>::infinity();

} // namespace

TEST_CASE("a scene that is told as it is known is believed") {
  told_drive_of_scenes x;
  x.know(seen_track({230, 0}));
  x.own.lead = x.lead(227.5);
  x.own.crossings = {{215, 220, 1, 3, true, forever, 7}};
  x.own.keep_free = {{260, 270}};
  CHECK_FALSE(x.go_on(5, x.own));
  CHECK(x.judge.left_s() == 1);
}

TEST_CASE("a lead that is known and not told, or told farther or faster, is "
          "used from the first result on, and refused after a second") {
  told_drive_of_scenes x;
  x.know(seen_track({230, 0}));
  x.own.lead = x.lead(227.5);
  driving_scene lie;
  SUBCASE("not told") {}
  SUBCASE("farther") {
    lie.lead = x.lead(240);
  }
  SUBCASE("faster") {
    lie.lead = x.lead(227.5, 8);
  }
  CHECK_FALSE(x.step(lie).refused);
  REQUIRE(x.told.lead);
  CHECK(x.told.lead->rear_s_m == 227.5);
  CHECK(x.told.lead->speed_mps == 0);
  const auto end = x.go_on(3, lie);
  REQUIRE(end);
  CHECK(end->first == "lead");
  CHECK(end->second < 1.3);
}

TEST_CASE("who is told to lead before the lead that is known drives no faster, "
          "and does not lead from behind") {
  told_drive_of_scenes x;
  x.know(seen_track({230, 0}));
  x.own.lead = x.lead(227.5);
  driving_scene lie;
  SUBCASE("nearer and faster") {
    lie.lead = x.lead(222.5, 50);
    CHECK_FALSE(x.step(lie).refused);
    CHECK(x.told.lead->rear_s_m == 222.5);
  }
  SUBCASE("behind the own car") {
    lie.lead = x.lead(100);
    CHECK_FALSE(x.step(lie).refused);
    CHECK(x.told.lead->rear_s_m == 227.5);
  }
  CHECK(x.told.lead->speed_mps == 0);
  const auto end = x.go_on(3, lie);
  REQUIRE(end);
  CHECK(end->first == "lead");
}

TEST_CASE("how a known lead is going to drive, only itself tells") {
  told_drive_of_scenes x;
  x.know(seen_track({230, 0}));
  x.own.lead = x.lead(227.5);
  auto lie = x.own;
  lie.lead_told = {{227.5, 0}}; // and nobody leads from then on
  SUBCASE("it tells nothing") {}
  SUBCASE("it tells more") {
    x.own.lead_told = {{227.5, 0}, {227.5, 4}, {229, 6}};
  }
  SUBCASE("another one is told before it") {
    lie.lead->rear_s_m = 220;
    lie.lead_told = {{220, 0}};
  }
  CHECK_FALSE(x.step(lie).refused);
  REQUIRE(x.told.lead);
  CHECK(x.told.lead_told.size() == x.own.lead_told.size());
}

TEST_CASE(
    "a body that the vehicle knows to be beside its way, and that is told to "
    "lead, is not told to drive off") {
  told_drive_of_scenes x;
  x.know(seen_track({230, 1.6}));
  x.own.beside = {{227.5, 232.5, 0.7, 2.5, 0, 0, 0}};
  driving_scene lie;
  lie.lead = x.lead(227.5);
  lie.lead_told = {{227.5, 0}};
  SUBCASE("whom nobody leads") {}
  SUBCASE("whom somebody leads far ahead") {
    x.own.lead = x.lead(300, 10);
  }
  CHECK_FALSE(x.step(lie).refused);
  REQUIRE(x.told.lead);
  CHECK(x.told.lead_told.empty());
}

TEST_CASE("who is told to lead before a body beside the way, faster or from "
          "behind, hides it from nobody") {
  told_drive_of_scenes x;
  x.own.beside = {{227.5, 232.5, -2.6, -0.6, 0, 0, 0}};
  driving_scene lie;
  SUBCASE("faster") {
    lie.lead = x.lead(224.5, 50);
  }
  SUBCASE("from behind") {
    lie.lead = x.lead(100);
  }
  CHECK_FALSE(x.step(lie).refused);
  CHECK(x.told.beside.size() == 1);
}

TEST_CASE("who leaves hardly room enough may be told to be passed, where it "
          "is") {
  told_drive_of_scenes x;
  x.know(seen_track({230, -2.0}));
  x.own.lead = x.lead(227.5);
  driving_scene told;
  told.beside = {{227.4, 232.6, -2.95, -1.0, 0, 0, 0}};
  CHECK_FALSE(x.go_on(3, told));
  SUBCASE("but not to drive there") {
    told.beside[0].speed_mps = 20;
    CHECK(x.go_on(3, told));
    CHECK(x.told.lead);
  }
  SUBCASE("and not farther beside") {
    told.beside[0].high_m = -1.6;
    told.beside[0].low_m = -3.5;
    CHECK(x.go_on(3, told));
    CHECK(x.told.lead);
  }
}

TEST_CASE("who is told to cross where a body stands is no reason to forget the "
          "body, if it gives way or leaves") {
  crossing_user told_instead;
  SUBCASE("it gives way") {
    told_instead = {227, 233, 0.01, 0.3, false, forever, 7};
  }
  SUBCASE("it has left") {
    told_instead = {227, 233, -1, -0.5, true, forever, 7};
  }
  SUBCASE("it leaves soon") {
    told_instead = {227, 233, 0, 2, true, forever, 7};
  }
  driving_scene lie;
  lie.crossings = {told_instead};
  told_drive_of_scenes ahead;
  ahead.know(seen_track({230, 0}));
  ahead.own.lead = ahead.lead(227.5);
  CHECK_FALSE(ahead.step(lie).refused);
  CHECK(ahead.told.lead);
  CHECK(ahead.go_on(3, lie));
  told_drive_of_scenes beside;
  beside.know(seen_track({230, -1.6}));
  beside.own.beside = {{227.5, 232.5, -2.6, -0.6, 0, 0, 0}};
  CHECK_FALSE(beside.step(lie).refused);
  CHECK(beside.told.beside.size() == 1);
  CHECK(beside.go_on(3, lie));
}

TEST_CASE("who is known ahead may be told to cross while it is there") {
  told_drive_of_scenes x;
  auto turns_off = seen_track({230, 0}, 1.57, 4);
  x.know(turns_off);
  x.own.lead = x.lead(229);
  driving_scene told;
  told.crossings = {{227, 233, 0, 0.9, true, forever, 7}};
  x.tracks[0].at = x.now + 1h; // it is there at each look
  CHECK_FALSE(x.go_on(3, told));
}

TEST_CASE("a body beside is told as wide as it is known") {
  told_drive_of_scenes x;
  x.own.beside = {{220, 225, -2.5, -0.5, 0, 0, 0}};
  driving_scene lie;
  SUBCASE("not at all") {}
  SUBCASE("farther beside") {
    lie.beside = {{220, 225, -4.0, -1.2, 0, 0, 0}};
  }
  CHECK_FALSE(x.step(lie).refused);
  REQUIRE(x.told.beside.size() == 1);
  CHECK(x.told.beside[0].high_m == -0.5);
  const auto end = x.go_on(3, lie);
  REQUIRE(end);
  CHECK(end->first == "beside");
}

TEST_CASE("a body beside is told to drive as it does") {
  told_drive_of_scenes x;
  x.own.beside = {{227.5, 232.5, -2.6, -0.6, 0, 0, 0}};
  auto lie = x.own;
  lie.beside[0].speed_mps = 50;
  CHECK_FALSE(x.step(lie).refused);
  REQUIRE(x.told.beside.size() == 1);
  CHECK(x.told.beside[0].speed_mps == 0);
  const auto end = x.go_on(3, lie);
  REQUIRE(end);
  CHECK(end->first == "beside");
}

TEST_CASE("nobody is told more room beside a body than the vehicle knows of") {
  told_drive_of_scenes x;
  x.own.beside = {{227.5, 232.5, -2.6, -0.6, 0, 0, 0}};
  auto lie = x.own;
  SUBCASE("on the opposite lane") {
    lie.beside[0].left_m = 8;
  }
  SUBCASE("on the opposite lane, for a body that it does not know") {
    lie.beside.push_back({240, 245, -1, 1, 0, 0, 8});
  }
  SUBCASE("out of the lane") {
    lie.beside[0].lacks_m = 3;
  }
  SUBCASE("behind its middle") {
    lie.beside[0].to_m = 230;
  }
  CHECK_FALSE(x.step(lie).refused);
  for (const auto& o : x.told.beside) {
    CHECK(o.left_m == 0);
    CHECK(o.lacks_m == 0);
  }
  CHECK(x.told.beside[0].to_m == 232.5);
}

TEST_CASE("a body that is being passed takes what is known of it") {
  told_drive_of_scenes x;
  x.own.beside = {{202, 207, -2.6, -0.6, 0, 0, 3.5}};
  auto lie = x.own;
  lie.beside[0].left_m = 0; // no way round it: left out of the plan
  CHECK_FALSE(x.step(lie).refused);
  CHECK(x.told.beside[0].left_m == 3.5);
}

TEST_CASE("a body is beside the way until the own rear is past it") {
  told_drive_of_scenes x;
  x.own.beside = {{197, 202, -1.6, 0.4, 0, 0, 3.5}};
  CHECK_FALSE(x.step({}).refused);
  CHECK(x.told.beside.size() == 1);
}

TEST_CASE("who is known to leave a crossing ahead along the way may be told to "
          "lead there, no faster than it is, and is minded all the same") {
  told_drive_of_scenes x;
  x.know(seen_track({240, 1.0}, 0, 6));
  x.tracks[0].at = x.now + 1h; // it is there at each look
  x.own.crossings = {{232, 244, 0, 0.6, true, forever, 34}};
  driving_scene as_lead;
  as_lead.lead = x.lead(237.6, 6);
  CHECK_FALSE(x.go_on(5, as_lead));
  CHECK(x.told.crossings.size() == 1);
  SUBCASE("faster") {
    as_lead.lead->speed_mps = 12;
  }
  SUBCASE("elsewhere") {
    as_lead.lead = x.lead(250, 6);
  }
  SUBCASE("while it comes only") {
    x.own.crossings[0].enter_s = 2;
    x.own.crossings[0].leave_s = 3;
  }
  const auto end = x.go_on(3, as_lead);
  REQUIRE(end);
  CHECK(end->first == "crossing");
}

TEST_CASE("who crosses first is not told to brake for the own car") {
  told_drive_of_scenes x;
  x.own.crossings = {{220, 226, 0.5, 3, true, 4, 7}};
  auto lie = x.own;
  lie.crossings[0].brakes_mps2 = 0.1;
  CHECK_FALSE(x.step(lie).refused);
  CHECK(x.told.crossings[0].brakes_mps2 == 4);
}

TEST_CASE("who crosses first is told to be where it is, for as long") {
  told_drive_of_scenes x;
  x.own.crossings = {{220, 226, 1, 3, true, forever, 7}};
  auto lie = x.own;
  lie.crossings[0] = {225, 225, 2, 2.1, true, forever, 7};
  CHECK_FALSE(x.step(lie).refused);
  REQUIRE(x.told.crossings.size() == 1);
  const auto& used = x.told.crossings[0];
  CHECK(used.from_m == 220);
  CHECK(used.to_m == 226);
  CHECK(used.enter_s == 1);
  CHECK(used.leave_s == 3);
}

TEST_CASE("a crowd that crosses elsewhere hides nobody who is known to cross") {
  told_drive_of_scenes x;
  x.own.crossings = {{230, 236, 2, 6, true, forever, 7}};
  auto lie = x.own;
  SUBCASE("far away") {
    for (std::uint32_t k = 0; k < 4; ++k)
      lie.crossings.push_back({500. + k, 501. + k, -1, 150, true, 9, 100 + k});
  }
  SUBCASE("before, and for a moment") {
    lie.crossings.clear();
    for (std::uint32_t k = 0; k < 20; ++k)
      lie.crossings.push_back({209. + k, 210. + k, 0, 1, true, 9, 100});
    lie.crossings.push_back(x.own.crossings[0]);
  }
  x.step(lie);
  std::set<std::uint32_t> bodies;
  for (const auto& c : x.told.crossings)
    bodies.insert(c.body);
  CHECK(bodies.contains(7));
  CHECK(bodies.size() <= crossing_order::most_cars); // of a planner
  CHECK(x.told.crossings.size() <= crossing_order::most_windows);
}

TEST_CASE("who crosses first is not told to cross later, or to give way") {
  told_drive_of_scenes x;
  x.own.crossings = {{220, 226, 0.5, 3, true, forever, 7}};
  auto lie = x.own;
  SUBCASE("nobody crosses") {
    lie.crossings.clear();
  }
  SUBCASE("later") {
    lie.crossings[0].enter_s = 4;
    lie.crossings[0].leave_s = 6;
  }
  SUBCASE("it gives way") {
    lie.crossings[0].goes_first = false;
  }
  SUBCASE("elsewhere") {
    lie.crossings[0].from_m = 240;
    lie.crossings[0].to_m = 246;
  }
  CHECK_FALSE(x.step(lie).refused);
  CHECK(std::ranges::any_of(x.told.crossings, [](const auto& c) {
    return c.goes_first && c.from_m == 220 && c.enter_s == 0.5;
  }));
  const auto end = x.go_on(3, lie);
  REQUIRE(end);
  CHECK(end->first == "crossing");
}

TEST_CASE("crossings are where the own map has them") {
  told_drive_of_scenes x;
  x.own.keep_free = {{240, 250}};
  x.own.yields_m = {238};
  auto lie = x.own;
  SUBCASE("farther on") {
    lie.keep_free[0] = {248, 258};
  }
  SUBCASE("nowhere") {
    lie.keep_free.clear();
  }
  SUBCASE("one more") {
    lie.keep_free.push_back({280, 290});
  }
  SUBCASE("nobody has priority") {
    lie.yields_m.clear();
  }
  CHECK_FALSE(x.step(lie).refused);
  CHECK(x.told.keep_free.front().from_m == 240);
  CHECK(x.told.yields_m == x.own.yields_m);
  const auto end = x.go_on(3, lie);
  REQUIRE(end);
  CHECK(end->first == "map");
}

TEST_CASE("a lead where the vehicle looks freely and sees nobody is refused") {
  told_drive_of_scenes x;
  driving_scene lie;
  lie.lead = x.lead(220);
  const auto end = x.go_on(3, lie);
  REQUIRE(end);
  CHECK(end->first == "added");
  CHECK(end->second < 1.3);
}

TEST_CASE("a lead that something hides is believed") {
  told_drive_of_scenes x;
  x.seen = {{{212, 0}, 0, 8, 0, 5.1, 1.89}};
  driving_scene told;
  told.lead = x.lead(220, 8);
  CHECK_FALSE(x.go_on(3, told));
}

TEST_CASE("who waits for what it does not know of refuses that in the end") {
  told_drive_of_scenes x;
  x.speed_mps = 0;
  driving_scene told;
  told.crossings = {{210, 216, 2, 6, true, forever, 7}};
  CHECK_FALSE(x.go_on(11, told));
  const auto end = x.go_on(3, told);
  REQUIRE(end);
  CHECK(end->first == "waits");
}

TEST_CASE("who lacks centimetres to pass may be told to wait") {
  told_drive_of_scenes x;
  x.speed_mps = 0;
  x.know(seen_track({215, 2}));
  lane_obstacle tight{212, 217, 1.2, 3};
  tight.lacks_m = 0.02;
  x.own.beside = {tight};
  driving_scene told;
  told.lead = x.lead(212);
  CHECK_FALSE(x.go_on(14, told));
}

TEST_CASE("nobody is told to be impatient who is not") {
  told_drive_of_scenes x;
  driving_scene told;
  told.is_impatient = true;
  CHECK_FALSE(x.step(told).refused);
  CHECK_FALSE(x.told.is_impatient);
}

TEST_CASE("a lead drives no faster than its kind can, and not as it never "
          "could") {
  told_drive_of_scenes x;
  x.know(seen_track({230, 0}));
  x.own.lead = x.lead(227.5);
  auto lie = x.own;
  SUBCASE("its speed") {
    lie.lead = x.lead(400, 90);
    x.own.lead.reset();
    x.tracks.clear();
    x.seen.clear();
    const auto end = x.go_on(3, lie);
    REQUIRE(end);
    CHECK(end->first == "limits");
  }
  SUBCASE("its drive as it tells it") {
    lie.lead_told = {{227.5, 0}, {300, 2}};
    CHECK_FALSE(x.step(lie).refused);
    CHECK(x.told.lead_told.empty());
    CHECK(x.go_on(3, lie));
  }
}
