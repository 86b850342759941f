// What is made of an imported map: a picture, and a first scenario.
#include "tests/maps/files.hpp"

#include "maps/picture.hpp"
#include "maps/proposal.hpp"
#include <pugixml.hpp>
#include <stdexcept>

namespace sofof::maps_tests::drawing {

TEST_CASE("a picture of a map is XML and names its lanes") {
  auto map = imported("t_junction.net.xml");
  map.name = "<T> & co";
  const auto text = maps::draw(
      streets_of(map), {{{"mec", {0, 0}, {{0, 0}, {9, 0}, {0, 9}}}}, {}});
  pugi::xml_document svg;
  REQUIRE(svg.load_string(text.c_str()));
  CHECK(std::string_view{svg.document_element().name()} == "svg");
  CHECK(text.find("west_in_0, ") != text.npos);
  CHECK(text.find("&lt;T&gt; &amp; co: 13 lanes, 6 routes") != text.npos);
  CHECK(text.find(":J_2_0 crosses :J_5_0") != text.npos);
}

TEST_CASE("providers are proposed where most ways cross") {
  const auto made = streets_of(imported("t_junction.net.xml"));
  const auto junctions = maps::busiest_junctions(made, 3, 100);
  REQUIRE(junctions.size() == 1);
  CHECK(distance_m(junctions[0].at, {-50, 40}) < 15);
  const auto text = maps::propose_scenario(made, "t", "t_map.toml");
  CHECK(text.find("map = \"t_map.toml\"") != text.npos);
  CHECK(text.find("name = \"edge 1\"") != text.npos);
}

TEST_CASE("a map without routes has no first scenario") {
  auto map = imported("t_junction.net.xml");
  map.routes.clear();
  CHECK_THROWS_AS(maps::propose_scenario(streets_of(map), "t", "t.toml"),
                  std::invalid_argument);
}

} // namespace sofof::maps_tests::drawing
