// Who takes part: every policy, and lines of a file.
#include "base/input_error.hpp"
#include "base/options/toml_nodes.hpp"
#include "experiments/benchmark/entrants.hpp"
#include "policies/registry.hpp"
#include "scenario/load.hpp"
#include "tests/support/bench_town.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

namespace sofof::experiments::bench {

using namespace policies;
using namespace scenario;
namespace {

const entrant& find(const std::vector<entrant>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &entrant::name);
  REQUIRE(found != all.end());
  return *found;
}

std::string refusal(std::string_view text) {
  try {
    parse_entrants(text, "mine.toml");
  } catch (const input_error& problem) {
    return problem.what();
  }
  return "";
}

constexpr auto two_lines = R"(# mine
near = { lodm = "nearest" }
both = { lodm = { name = "least_loaded", most = 0.5 }, codm = "edf" }
)";

} // namespace

TEST_CASE("every policy takes part beside location, and location once") {
  const auto all = plain_entrants();
  // Of "location" there is one, of "process" none.
  CHECK(all.size() == lodm_names().size() + codm_names().size() - 3);
  std::set<std::string> names;
  for (const auto& one : all)
    names.insert(one.name);
  CHECK(names.size() == all.size());
  CHECK(find(all, "nearest").codm == "location");
  CHECK(find(all, "oracle").codm == "assignment");
  CHECK(find(all, "edf").lodm == "location");
  CHECK(find(all, "always").codm == "location");
  CHECK(find(all, "codm:always").codm == "always");
}

TEST_CASE("a scenario takes the policies of every entrant, whatever it had") {
  auto all = plain_entrants();
  std::ranges::move(parse_entrants(two_lines, "mine.toml"),
                    std::back_inserter(all));
  for (const auto& one : all) {
    CAPTURE(one.name);
    const auto s =
        parse_scenario(test::bench_town, "town.toml", one.as_value().given);
    CHECK(one.lodm.find(s.policies.lodm->name()) != one.lodm.npos);
    CHECK(one.codm.find(s.policies.codm->name()) != one.codm.npos);
  }
}

TEST_CASE("an entrant of a file has its options, and location for the rest") {
  const auto all = parse_entrants(two_lines, "mine.toml");
  REQUIRE(all.size() == 2);
  CHECK(find(all, "near").lodm == "nearest");
  CHECK(find(all, "near").codm == "location");
  CHECK(find(all, "both").as_value().given
        == std::vector<std::string>{
            R"(policies.lodm={ most = 0.5, name = "least_loaded" })",
            "policies.codm=edf"});
}

TEST_CASE("files that an entrant names are sought from its own file on, "
          "wherever the scenario is") {
  const auto all = parse_entrants(
      "mine = { lodm = { name = \"process\", command = \"./mine\" } }\n"
      "its = { codm = { name = \"process\", command = \"x\", folder = \"of\" } "
      "}\n"
      "taught = { lodm = { name = \"dqn\", snapshot = \"dqn.txt\" } }\n"
      "there = { lodm = { name = \"dqn\", snapshot = \"/a/dqn.txt\" } }\n",
      "/some/where/mine.toml");
  CHECK(find(all, "mine").lodm.find("folder = \"/some/where\"")
        != std::string::npos);
  CHECK(find(all, "its").codm.find("folder = \"/some/where/of\"")
        != std::string::npos);
  CHECK(find(all, "taught").lodm.find("snapshot = \"/some/where/dqn.txt\"")
        != std::string::npos);
  CHECK(find(all, "there").lodm.find("snapshot = \"/a/dqn.txt\"")
        != std::string::npos);
}

TEST_CASE("mistakes in a file of entrants are found where they stand") {
  CHECK(refusal("x = { lodm = \"nearst\" }\n")
            .starts_with("mine.toml:1:14: name: "));
  CHECK(refusal("\nx = { codm = { name = \"edf\", most = 2 } }\n")
            .starts_with("mine.toml:2:"));
  CHECK(refusal("x = { lodm = \"nearest\", comd = \"edf\" }\n").find("comd")
        != std::string::npos);
  CHECK(refusal("x = \"nearest\"\n")
        == "mine.toml:1:5: an entrant is a table, { lodm = POLICY, codm = "
           "POLICY }.");
  CHECK(refusal("nearest = { lodm = \"nearest\" }\n").find("already")
        != std::string::npos);
  CHECK(refusal("all = { lodm = \"nearest\" }\n").find("means all")
        != std::string::npos);
  CHECK(refusal("\"a,b\" = { lodm = \"nearest\" }\n").find("is no name")
        != std::string::npos);
  CHECK(refusal("x = \n").starts_with("mine.toml:1:"));
  CHECK_THROWS_WITH_AS(
      load_entrants("no_such.toml"),
      "no_such.toml: this file cannot be read: No such file or directory.",
      input_error);
}

TEST_CASE("what a scenario says of policies takes part under its file's name") {
  const auto own = own_entrant("config/busy_worker.toml");
  REQUIRE(own.has_value());
  CHECK(own->name == "busy_worker.toml");
  CHECK(own->lodm == "always");
  CHECK(own->codm.find("\"phases\"") != std::string::npos);
  // Location on both sides takes part already.
  CHECK_FALSE(own_entrant("config/bench/spiky_5g.toml").has_value());
  CHECK_FALSE(own_entrant("config/ulm_lehr.toml").has_value()); // says it all
  CHECK_FALSE(own_entrant("no_such.toml").has_value());
}

TEST_CASE("no two entrants have one name") {
  auto all =
      parse_entrants("\"busy_worker.toml\" = { codm = \"edf\" }", "mine.toml");
  CHECK_THROWS_WITH_AS(add_own_entrants(all, {"config/busy_worker.toml"}),
                       doctest::Contains("already"), input_error);
}

TEST_CASE("some of them can be chosen, in any order") {
  const auto all = plain_entrants();
  CHECK(chosen_from(all, "all").size() == all.size());
  const auto two = chosen_from(all, "nearest,edf");
  REQUIRE(two.size() == 2);
  CHECK(two[0].name == "nearest");
  CHECK(two[1].name == "edf");
  CHECK_THROWS_WITH_AS(chosen_from(all, "edf,nearst"),
                       doctest::Contains("did you mean \"nearest\"?"),
                       input_error);
  CHECK_THROWS_WITH_AS(chosen_from(all, "edf,edf"),
                       "the entrant \"edf\" stands there twice.", input_error);
  CHECK_THROWS_AS(chosen_from(all, ""), input_error);
  CHECK_THROWS_WITH_AS(chosen_from(all, "edf,all"),
                       "\"all\" has everybody in it; let it stand alone.",
                       input_error);
}

TEST_CASE("a policy may be chosen by its name behind its side") {
  const auto all = plain_entrants();
  const auto some =
      chosen_from(all, "codm:edf,codm:always,lodm:always,lodm:nearest");
  REQUIRE(some.size() == 4);
  CHECK(some[0].name == "edf");
  CHECK(some[1].codm == "always");
  CHECK(some[2].lodm == "always");
  CHECK(some[3].name == "nearest");
  CHECK_THROWS_AS(chosen_from(all, "lodm:edf"), input_error);
  CHECK_THROWS_WITH_AS(chosen_from(all, "edf,codm:edf"),
                       "the entrant \"edf\" stands there twice.", input_error);
}

TEST_CASE("the entrants that come with the program are as they should be") {
  CHECK_FALSE(load_entrants("config/policies.toml").empty());
}

TEST_CASE("a TOML value on one line reads back as what it was") {
  for (const auto* text :
       {"7", "0.25", "true", "\"a \\\"b\\\"\"", "[1, 2]",
        "{ \"odd key\" = [{ a = 1 }, { b = \"x\" }], c = {  } }"}) {
    CAPTURE(text);
    const auto table = parse_toml(std::string{"x = "} + text, "here");
    const auto line = value_text(*table.get("x"));
    CHECK(line.find('\n') == line.npos);
    CHECK((parse_toml("x = " + line, "here") == table));
  }
}

} // namespace sofof::experiments::bench
