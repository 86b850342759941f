// Tests of what the program writes for who begins.
#include "tests/processes/workplace.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"

using namespace sofof::test;

TEST_CASE("a new scenario runs as it is, and a second one overwrites nothing") {
  const workplace at;
  const auto made = at.run_sofof({"new", "mine"});
  CHECK(made.code == 0);
  CHECK(contains(made.out, "sofof run mine.toml"));
  const auto run = at.run_sofof({"run", "mine.toml", "--duration", "10s"});
  CHECK(run.code == 0);
  CHECK(run.err == "");
  at.write("mine.toml", "changed");
  const auto again = at.run_sofof({"new", "mine.toml"});
  CHECK(again.code == 2);
  CHECK(contains(again.err, "mine.toml is there already"));
  CHECK(read_file(at / "mine.toml") == "changed");
}

TEST_CASE("a new scenario that cannot be written leaves nothing behind") {
  const workplace at;
  const auto before = at.inventory();
  CHECK(at.run_sofof({"new", "no_such_folder/mine"}).code == 2);
  CHECK(at.run_sofof({"new", ""}).code == 2);
  conditions full;
  full.largest_file = 100;
  const auto end = at.run_sofof({"new", "mine"}, full);
  CHECK(end.code != 0);
  CHECK(contains(end.err, "mine.toml"));
  CHECK(at.inventory() == before);
}

TEST_CASE("schema, completion and manual are printed, others are not known") {
  const workplace at;
  CHECK(contains(at.run_sofof({"schema", "map"}).out, "\"half_width_m\""));
  CHECK(contains(at.run_sofof({"completion", "zsh"}).out, "#compdef sofof"));
  CHECK(contains(at.run_sofof({"manual"}).out, ".TH SOFOF 1"));
  const auto end = at.run_sofof({"completion", "fish"});
  CHECK(end.code == 2);
  CHECK(contains(end.err, "Known: bash, zsh."));
}
