// Tests of what the program tells of its policies.
#include "tests/processes/workplace.hpp"

#include <sstream>

using namespace sofof::test;

namespace {

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != text.npos;
}

/// @returns the names listed, those of the vehicle's policies first.
std::vector<std::string> listed(const std::string& text) {
  std::istringstream lines{text};
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  "))
      all.push_back(line.substr(2, line.find(' ', 2) - 2));
  return all;
}

} // namespace

TEST_CASE("every policy that is listed is described, and what is said of its "
          "options is a scenario") {
  const workplace at;
  const auto end = at.run_sofof({"policies"});
  CHECK(end.code == 0);
  CHECK(end.err == "");
  const auto names = listed(end.out);
  CHECK(names.size() >= 10);
  for (const auto& name : names) {
    CAPTURE(name);
    const auto one = at.run_sofof({"policies", name});
    CHECK(one.code == 0);
    CHECK(contains(one.out, "decides by: "));
    CHECK(contains(one.out, "source: "));
    const auto side = contains(one.out, name + " as lodm") ? "lodm" : "codm";
    const auto table = one.out.find(std::string{"[policies."} + side + "]");
    REQUIRE(table != one.out.npos);
    const auto effective =
        at.run_sofof({"check", "config/ulm_lehr.toml", "--set",
                      std::string{"policies."} + side + "=" + name});
    CHECK(effective.code == 0);
    const auto options =
        one.out.substr(table, one.out.find(" as codm", table) - table);
    const auto first_lines = options.substr(0, options.find("\n\n"));
    CHECK(contains(effective.out, first_lines));
  }
}

TEST_CASE("an unknown policy is refused, and the one meant is named") {
  const workplace at;
  const auto end = at.run_sofof({"policies", "nearst"});
  CHECK(end.code == 2);
  CHECK(end.out == "");
  CHECK(contains(end.err, "did you mean \"nearest\"?"));
}
