// Maps that are wrong, or would take hours.
#include "base/input_error.hpp"
#include "tests/maps/files.hpp"

#include <fmt/format.h>

#include <chrono>

namespace sofof::maps_tests::limits {

namespace {

std::string refusal_of(const std::string& text, std::string_view file) {
  try {
    imported(text, file);
  } catch (const input_error& problem) {
    return problem.what();
  }
  return "";
}

std::string replaced(std::string_view file, std::string_view what,
                     std::string_view instead) {
  auto text = text_of(file);
  const auto at = text.find(what);
  REQUIRE(at != text.npos);
  return text.replace(at, what.size(), instead);
}

std::string node_at(int id, double x_m, double y_m) {
  return fmt::format("<node id=\"{}\"><tag k=\"local_x\" v=\"{}\"/>"
                     "<tag k=\"local_y\" v=\"{}\"/></node>\n",
                     id, x_m, y_m);
}

std::string lanelet_between(int id, std::string_view left,
                            std::string_view right) {
  return fmt::format("<relation id=\"{}\"><member ref=\"{}\" role=\"left\"/>"
                     "<member ref=\"{}\" role=\"right\"/>"
                     "<tag k=\"type\" v=\"lanelet\"/>"
                     "<tag k=\"subtype\" v=\"road\"/></relation>\n",
                     id, left, right);
}

/// Lanelets that begin and end at the same two nodes.
std::string ring_lanelets(int count) {
  return "<osm>" + node_at(1, 0, 3) + node_at(2, 60, 30) + node_at(3, 0, 0)
         + node_at(4, 60, 27)
         + "<way id=\"l\"><nd ref=\"1\"/><nd ref=\"2\"/><nd ref=\"1\"/></way>"
           "<way id=\"r\"><nd ref=\"3\"/><nd ref=\"4\"/><nd ref=\"3\"/></way>"
         +
         [count] {
           std::string all;
           for (auto i = 0; i < count; ++i)
             all += lanelet_between(i + 1, "l", "r");
           return all;
         }()
         + "</osm>";
}

constexpr std::string_view first_bound =
    R"(<member type="way" ref="100" role="left"/>)";
constexpr std::string_view first_way =
    R"(<way id="100"><nd ref="1"/><nd ref="2"/>)";

} // namespace

TEST_CASE("lanes that all follow each other are refused, and soon") {
  const auto begin = std::chrono::steady_clock::now();
  const auto why = refusal_of(ring_lanelets(20'000), "ring.osm");
  CHECK(why.starts_with("ring.osm:"));
  CHECK(
      why.ends_with("more than 64 lanes follow one; leave some of them out."));
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds{10});
}

TEST_CASE("lines of too many points, or too long ones, are refused") {
  std::string shape;
  for (auto i = 0; i < 10'001; ++i)
    shape += fmt::format("{}{},0", i ? " " : "", i * 0.01);
  const auto net = [](std::string_view points) {
    return fmt::format(
        "<net><location netOffset=\"0,0\" convBoundary=\"0,0,9,9\"/>\n"
        "<edge id=\"e\"><lane id=\"e_0\" speed=\"9\" shape=\"{}\"/></edge>"
        "</net>",
        points);
  };
  CHECK(refusal_of(net(shape), "n.net.xml")
            .ends_with("2:15: this lane has a line of 10001 points; 10000 are "
                       "the most."));
  CHECK(refusal_of(net("0,0 25000,0"), "n.net.xml")
            .ends_with("2:15: this lane is 25 km long; 20 km are the most."));
}

TEST_CASE("a bound of several ways is joined, whichever way they are drawn") {
  const auto way_of_two = [](std::string_view halves) {
    auto text = replaced("fork.osm", first_bound,
                         R"(<member ref="a" role="left"/>)"
                         R"(<member ref="b" role="left"/>)");
    const auto at = text.find(first_way);
    text.insert(at, std::string{R"(<node id="9" lat="48.42002698" )"
                                R"(lon="9.96040"/>)"}
                        + std::string{halves});
    return text;
  };
  const auto whole = imported("fork.osm");
  for (const auto* halves :
       {R"(<way id="a"><nd ref="1"/><nd ref="9"/></way>)"
        R"(<way id="b"><nd ref="9"/><nd ref="2"/></way>)",
        R"(<way id="a"><nd ref="9"/><nd ref="1"/></way>)"
        R"(<way id="b"><nd ref="9"/><nd ref="2"/></way>)",
        R"(<way id="a"><nd ref="9"/><nd ref="1"/></way>)"
        R"(<way id="b"><nd ref="2"/><nd ref="9"/></way>)"}) {
    const auto map = imported(way_of_two(halves), "f.osm");
    CHECK(lane_of(map, "1000").next == lane_of(whole, "1000").next);
    CHECK(length_m(lane_of(map, "1000").centre)
          == doctest::Approx(60).epsilon(0.01));
  }
  CHECK(
      refusal_of(way_of_two(R"(<way id="a"><nd ref="1"/><nd ref="9"/></way>)"
                            R"(<way id="b"><nd ref="3"/><nd ref="2"/></way>)"),
                 "f.osm")
          .ends_with("way \"b\" of the left bound does not begin where the "
                     "one before it ends."));
}

TEST_CASE("two lanelets of one name are refused, the way back included") {
  CHECK(refusal_of(replaced("fork.osm", "<relation id=\"1002\"",
                            "<relation id=\"1001\""),
                   "f.osm")
            .ends_with("there are two lanelets \"1001\"."));
  CHECK(refusal_of(replaced("fork.osm", "<relation id=\"1002\"",
                            "<relation id=\"1003 back\""),
                   "f.osm")
            .ends_with("there are two lanelets \"1003 back\"."));
}

TEST_CASE("two routes of one name are refused") {
  const auto net = text_of("t_junction.net.xml");
  const auto demand = replaced("t_junction.rou.xml", "<vehicle",
                               "<route id=\"through\" edges=\"far\"/><vehicle");
  CHECK_THROWS_WITH_AS(
      maps::import({net, "t.net.xml"}, "t", {demand, "t.rou.xml"}),
      doctest::Contains("there are two routes \"through\"."), input_error);
}

TEST_CASE("names that are no UTF-8 are refused with the place") {
  for (const auto* name : {"\xfc", "\xc3", "\xed\xa0\x80", "\xf4\x90\x80\x80"})
    CHECK(refusal_of(replaced("t_junction.net.xml", "id=\"far_0\"",
                              fmt::format("id=\"{}\"", name)),
                     "t.net.xml")
              .ends_with("\"id\" of <lane> is no UTF-8; save the file with "
                         "this encoding."));
  const auto map = imported(
      replaced("fork.xml", "<lanelet id=\"1\"", "<lanelet id=\"stra\u00dfe\""),
      "f.xml");
  CHECK(find_lane(map, "stra\u00dfe"));
}

TEST_CASE("lanes without a length are left out") {
  const auto map =
      imported(replaced("t_junction.net.xml", "</net>",
                        "<edge id=\"dot\"><lane id=\"dot_0\" speed=\"9\" "
                        "shape=\"5,5 5,5.001\"/></edge></net>"),
               "t.net.xml");
  CHECK(!find_lane(map, "dot_0"));
  CHECK(map.left_out.at("lanes shorter than 1 cm") == 1);
}

TEST_CASE("south of the equator a map has no place on earth") {
  const auto net =
      imported(replaced("t_junction.net.xml", "+zone=32", "+zone=32 +south"),
               "t.net.xml");
  CHECK(!net.origin);
  CHECK(net.left_out.at(maps::southern) == 1);
  auto text = text_of("fork.osm");
  for (auto at = text.find("lat=\"48.4"); at != text.npos;
       at = text.find("lat=\"48.4", at))
    text.replace(at, 9, "lat=\"-0.0");
  const auto osm = imported(text, "f.osm");
  CHECK(!osm.origin);
  CHECK(osm.left_out.at(maps::southern) == 1);
}

TEST_CASE("many routes of one name are told apart in little time") {
  maps::imported_map map;
  for (auto i = 0; i < 30'000; ++i)
    map.routes.push_back({"r", {}});
  map.routes.push_back({"r 7", {}});
  const auto begin = std::chrono::steady_clock::now();
  const auto text = to_toml(map);
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds{10});
  CHECK(text.find("\"r 30000\"") != text.npos);
  CHECK(text.find("\"r 7 2\"") != text.npos);
}

} // namespace sofof::maps_tests::limits
