// Networks of SUMO.
#include "base/input_error.hpp"
#include "tests/maps/files.hpp"

namespace sofof::maps_tests::sumo {

namespace {

std::string with(std::string_view what, std::string_view instead) {
  auto text = text_of("t_junction.net.xml");
  const auto at = text.find(what);
  REQUIRE(at != text.npos);
  return text.replace(at, what.size(), instead);
}

std::string refusal(const std::string& text) {
  try {
    imported(text, "t.net.xml");
  } catch (const input_error& problem) {
    return problem.what();
  }
  return "";
}

} // namespace

TEST_CASE("a network of SUMO becomes lanes that a car can follow") {
  const auto map = imported("t_junction.net.xml");
  check_drivable(map);
  CHECK(map.warnings.empty());
  CHECK(map.lanes.size() == 13);
}

TEST_CASE("a connection leads over the lane in the junction") {
  const auto map = imported("t_junction.net.xml");
  CHECK(lane_of(map, "west_in_0").next
        == std::vector<std::string>{":J_2_0", ":J_3_0"});
  CHECK(lane_of(map, ":J_3_0").next == std::vector<std::string>{"south_out_0"});
}

TEST_CASE("what cars cannot use is left out and counted") {
  const auto map = imported("t_junction.net.xml");
  CHECK(!find_lane(map, ":J_6_0"));
  CHECK(!find_lane(map, "far_1"));
  CHECK(!find_lane(map, "alone_0"));
  CHECK(map.left_out
        == maps::tally{{"U-turns", 1},
                       {"footways", 1},
                       {"lanes closed to cars", 1},
                       {"lanes of isolated parts", 1},
                       {"lanes shorter than 1 m, joined to others", 1},
                       {"traffic lights", 1}});
}

TEST_CASE("a lane shorter than a metre is a part of the one before it") {
  const auto map = imported("t_junction.net.xml");
  CHECK(!find_lane(map, ":K_0_0"));
  CHECK(lane_of(map, "east_out_0").next == std::vector<std::string>{"far_0"});
  CHECK(lane_of(map, "east_out_0").centre.back().x_m
        == doctest::Approx(100.5 - 50)); // the middle of the network is at 50
}

TEST_CASE("who yields to more others in a row has the higher rank") {
  const auto map = imported("t_junction.net.xml");
  const auto rank = [&map](std::string_view name) {
    return lane_of(map, name).rank;
  };
  CHECK(rank(":J_0_0") == 0);
  CHECK(rank(":J_1_0") == 1); // left, oncoming traffic goes first
  CHECK(rank(":J_2_0") == 0);
  CHECK(rank(":J_4_0") == 1);
  CHECK(rank(":J_5_0") == 2); // left from the side road
}

TEST_CASE("a map knows where on earth it is") {
  const auto map = imported("t_junction.net.xml");
  REQUIRE(map.origin);
  CHECK(map.origin->utm_zone == 32);
  CHECK(map.origin->utm_e_m == 570'050);
  CHECK(map.origin->utm_n_m == 5'359'960);
}

TEST_CASE("a turn is as wide as a car needs it") {
  const auto map = imported("t_junction.net.xml");
  CHECK(lane_of(map, "west_out_0").half_width_m == doctest::Approx(1.6));
  CHECK(lane_of(map, ":J_3_0").half_width_m > 1.75);
}

TEST_CASE(
    "lanes that no car can follow are named, and no way leads over them") {
  const auto text = with("-1.60,-10.00 -1.60,-100.00",
                         "-1.60,-10.00 -1.60,-60 -12,-60 -12,-90");
  const auto map = imported(text, "t.net.xml");
  REQUIRE(map.warnings.size() == 1);
  CHECK(map.warnings[0].starts_with("no car can follow 1 of 13 lanes"));
  CHECK(map.warnings[0].ends_with(": \"south_out_0\"."));
  for (const auto& r : map.routes)
    CHECK(std::ranges::find(r.lanes, "south_out_0") == r.lanes.end());
}

TEST_CASE("routes of SUMO lead over lanes, and vehicles depart on them") {
  const auto net = text_of("t_junction.net.xml");
  const auto demand = text_of("t_junction.rou.xml");
  auto map = maps::import({net, "t.net.xml"}, "t", {demand, "t.rou.xml"});
  REQUIRE(map.routes.size() == 2);
  CHECK(map.routes[0].name == "through");
  CHECK(map.routes[0].lanes
        == std::vector<std::string>{"west_in_0", ":J_2_0", "east_out_0",
                                    "far_0"});
  REQUIRE(map.departures.size() == 3);
  CHECK(map.departures[1].vehicle == "c");
  CHECK(map.departures[1].at_s == 2); // after the first
  CHECK(map.left_out.at("routes that need a lane change or a closed lane")
        == 1); // the U-turn
  CHECK(map.left_out.at("vehicles on these") == 1);
  CHECK(map.left_out.at("trips") == 1);
  CHECK(map.left_out.at("flows") == 1);
  const auto scenario = maps::to_scenario(map, "t.toml");
  CHECK(scenario.find("appears_at = \"4500ms\"") != scenario.npos);
  streets_of(map);
}

TEST_CASE("a network that is wrong is refused with the place") {
  CHECK(refusal(with("speed=\"8.33\"", "speed=\"fast\""))
            .starts_with("t.net.xml:"));
  CHECK(refusal(with("speed=\"8.33\"", "speed=\"fast\""))
            .ends_with("\"fast\" of <lane> is no number."));
  CHECK(refusal(with("to=\"far\"", "to=\"nowhere\""))
            .ends_with("there is no lane \"nowhere_0\"."));
  CHECK(refusal(with("</junction>", "")).find("this is no XML")
        != std::string::npos);
  CHECK(refusal("<net>\n</net>") == "t.net.xml:1:2: <net> needs a <location>.");
}

TEST_CASE("formats that netconvert reads are refused with its command") {
  CHECK(refusal("<OpenDRIVE/>").find("netconvert --opendrive-files t.net.xml")
        != std::string::npos);
  CHECK(refusal("<osm><node id=\"1\"/></osm>").find("--osm-files t.net.xml")
        != std::string::npos);
  CHECK(refusal("<gpx/>").ends_with(
      "<gpx> is none of <net> (SUMO), <osm> (Lanelet2) and <commonRoad>."));
}

} // namespace sofof::maps_tests::sumo
