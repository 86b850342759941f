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
