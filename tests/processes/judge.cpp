// Tests of scenarios of others, judged by the program.
#include "tests/processes/workplace.hpp"
#include "tests/support/contains.hpp"

using namespace sofof::test;

namespace {

const std::string& judge_scene() {
  static const std::string file{SOFOF_SOURCE_DIR "/tests/maps/data/scene.xml"};
  return file;
}

} // namespace

TEST_CASE("a judged scenario comes with a report, a table and a solution") {
  const workplace at;
  const auto end = at.run_sofof({"judge", judge_scene(), "--out", "judged"});
  CAPTURE(end.err);
  CHECK(end.code == 0);
  CHECK(contains(end.out, "1 planning problem: 1 reached (100.0 %)"));
  for (const auto* name : {"judge.html", "judge.csv", "scene.toml",
                           "scene_map.toml", "solution_KS2_SM1_scene.xml"}) {
    CAPTURE(name);
    CHECK(std::filesystem::exists(at / "judged" / name));
  }
  CHECK(at.run_sofof({"check", "judged/scene.toml"}).code == 0);
  const auto again = at.run_sofof({"judge", judge_scene(), "--out", "judged"});
  CHECK(again.code == 2);
  CHECK(contains(again.err, "add --force"));
}

TEST_CASE("a wrong scenario is a row of the table, and exit code 2") {
  const workplace at;
  at.write("bad.xml", "<commonRoad>");
  const auto end = at.run_sofof({"judge", "bad.xml", judge_scene()});
  CHECK(end.code == 2);
  CHECK(contains(end.out, "bad.xml:1:"));
  CHECK(contains(end.out, "1 reached (50.0 %), 1 refused (50.0 %)"));
}
