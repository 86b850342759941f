// What is said about maps that are wrong.
#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "scenario/map_file.hpp"
#include "tests/scenario/example.hpp"
#include "tests/support/mistakes.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::scenario;
using namespace sofof::test;

namespace {

std::string error_of_map(std::string_view text) {
  try {
    parse_map(text, "town.toml");
    return {};
  } catch (const input_error& problem) {
    return problem.what();
  }
}

void check_map_mistakes(const std::vector<mistake>& mistakes) {
  const auto right = read_text(example::folder / "ring.toml");
  REQUIRE(right);
  REQUIRE(error_of_map(*right) == "");
  for (const auto& m : mistakes) {
    CAPTURE(m.wrong);
    auto text = example::with(m.right, m.wrong, *right);
    const auto place = "town.toml" + take_mark(text);
    check_says(error_of_map(text), place, m.says);
  }
}

} // namespace

TEST_CASE("a wrong option of a map is refused with its place") {
  check_map_mistakes({
      {"utm_zone", "@utm_zome", {"did you mean \"utm_zone\"?"}},
      {"utm_zone = 32", "utm_zone = @61", {"from 1 to 60"}},
      {"half_width_m = 1.75", "half_width_m = @0", {"half_width_m"}},
      {"limit_mps = 13.9", "limit_mps = @-13.9", {"limit_mps"}},
      {"[200.0, 0.0]", "[@\"200\", 0.0]", {"a number"}},
      {"corners_m = [[-20.0, -10.0], [20.0, -10.0]",
       "corners_m = @[[-20.0, -10.0], [20.0, 10.0], [20.0, -10.0]",
       {"crosses itself"}},
  });
}

TEST_CASE("a lane that is wrong by itself is refused with its place") {
  check_map_mistakes({
      {"[[lane]]\nname = \"inner_north\"",
       "[[lane]]\nname = @\"outer_north\"",
       {"two lanes 'outer_north'"}},
      {"[[lane]]\nname = \"straight\"\nhalf_width_m = 1.75\nlimits = [{ from_m "
       "= 0.0, ",
       "@[[lane]]\nname = \"straight\"\nhalf_width_m = 1.75\nlimits = [{ "
       "from_m "
       "= 5.0, ",
       {"'straight'", "from 0 m on"}},
      {"[[lane]]\nname = \"straight\"", "[[lane]]\nname = @\"\"", {"name"}},
  });
}

TEST_CASE("lanes that do not meet are refused with their place") {
  check_map_mistakes({
      {"[[lane]]\nname = \"outer_south\"\nhalf_width_m = 1.75\nlimits = [{ "
       "from_m = 0.0, limit_mps = 13.9 }]\nnext = [\"outer_north\"]",
       "@[[lane]]\nname = \"outer_south\"\nhalf_width_m = 1.75\nlimits = [{ "
       "from_m = 0.0, limit_mps = 13.9 }]\nnext = [\"straight\"]",
       {"outer_south", "100.0 m", "straight"}},
  });
}

TEST_CASE("a route that cannot be driven is refused with its place") {
  check_map_mistakes({
      {"lanes = [\"outer_north\", \"outer_south\"]",
       "lanes = @[\"outer_north\", \"inner_south\"]",
       {"round_trip", "'inner_south' does not follow 'outer_north'"}},
      {"lanes = [\"straight\"]",
       "lanes = @[\"curved\"]",
       {"straight", "'curved'", "not on the map"}},
      {"lanes = [\"straight\"]", "lanes = @[]", {"no lanes"}},
      {"name = \"round_trip_opposite\"",
       "name = @\"round_trip\"",
       {"two routes"}},
      {"[[route]]\nname = \"straight\"", "@[[route]]", {"name", "empty"}},
  });
}

TEST_CASE("a map without lanes is refused") {
  check_says(error_of_map("name = \"empty\""), "town.toml: ", {"[[lane]]"});
}

TEST_CASE("a mistake in a map is found through the scenario too") {
  const auto error =
      example::error_of(example::with("ring.toml", "delays.csv"));
  check_says(error, "delays.csv:1:", {});
}
