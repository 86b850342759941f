// Tests of maps that the program makes of others' files, and draws.
#include "tests/processes/workplace.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"

using namespace sofof::test;

namespace {

const std::string& map_data() {
  static const std::string folder{SOFOF_SOURCE_DIR "/tests/maps/data/"};
  return folder;
}

ending import_with_routes(const workplace& at) {
  return at.run_sofof({"import", map_data() + "t_junction.net.xml", "--routes",
                       map_data() + "t_junction.rou.xml", "-o", "t.toml"});
}

} // namespace

TEST_CASE("an imported map comes with a scenario of its vehicles") {
  const workplace at;
  const auto end = import_with_routes(at);
  CAPTURE(end.err);
  CHECK(end.code == 0);
  CHECK(contains(end.out, "t_traffic.toml: 3 vehicles"));
  CHECK(at.run_sofof({"check", "t_traffic.toml"}).code == 0);
  CHECK(import_with_routes(at).code == 0); // the same once more
}

TEST_CASE("a scenario of vehicles that was edited is not written over") {
  const workplace at;
  at.write("t_traffic.toml", "edited");
  const auto before = at.inventory();
  const auto end = import_with_routes(at);
  CHECK(end.code == 2);
  CHECK(contains(end.err, "t_traffic.toml is there already"));
  CHECK(at.inventory() == before);
}

TEST_CASE("a picture of a map overwrites neither the map nor other files") {
  const workplace at;
  const auto before = at.inventory();
  const std::string map = "config/maps/t_junction.toml";
  const auto end = at.run_sofof({"map", map, "-o", map});
  CHECK(end.code == 2);
  CHECK(contains(end.err, "choose a name that ends with .svg."));
  CHECK(at.inventory() == before);
  std::filesystem::create_symlink(at / map, at / "link.svg");
  const auto linked = at.run_sofof({"map", map, "-o", "link.svg"});
  CHECK(linked.code == 2);
  CHECK(contains(linked.err, "is what the picture is drawn of"));
  CHECK(at.run_sofof({"map", map, "-o", "t.svg"}).code == 0);
}
