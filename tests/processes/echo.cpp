// What the program says of a scenario is a scenario.
#include "tests/processes/workplace.hpp"

using namespace sofof::test;

namespace {

std::string check(const workplace& at, std::vector<std::string> words) {
  words.insert(words.begin(), "check");
  const auto end = at.run_sofof(words);
  CAPTURE(end.err);
  REQUIRE(end.code == 0);
  CHECK((end.err.empty() || end.err.starts_with("sofof: provider \"")));
  return end.out;
}

/// @returns the text before the first line that says how long results take.
std::string options_in(const std::string& text) {
  return text.substr(0, text.find("# Provider "));
}

} // namespace

TEST_CASE("what sofof check prints means the same again") {
  for (const std::string name :
       {"ulm_lehr.toml", "scale.toml", "occluded_crossing.toml"}) {
    CAPTURE(name);
    const workplace at;
    const auto once = check(at, {"config/" + name, "--seed", "42", "--set",
                                 "policies.codm=always"});
    CHECK(once.find("seed = 42") != once.npos);
    CHECK(once.find("always") != once.npos);
    at.write("config/again.toml", once);
    CHECK(check(at, {"config/again.toml"}) == once);
  }
}

TEST_CASE("checking a scenario writes nothing") {
  const workplace at;
  const auto before = at.inventory();
  check(at, {scenario_file});
  CHECK(at.inventory() == before);
}

TEST_CASE("the configuration of a run runs again, anywhere, to the same "
          "results") {
  const workplace at, elsewhere;
  const auto first = at.drive("first", {"--duration", "30s", "--seed", "3",
                                        "--set", "network.profile=paper_5g"});
  const auto config = read_file(first / "config.toml");
  CHECK(config.starts_with("# "));
  CHECK(config.ends_with(options_in(check(at, {"first/config.toml"}))));

  std::filesystem::copy(first, elsewhere / "copy");
  const auto end = elsewhere.run_sofof(
      {"run", "copy/config.toml", "--out", "second", "--quiet"});
  CAPTURE(end.err);
  REQUIRE(end.code == 0);
  for (const auto* name : {"config.toml", "cycles.csv", "tracks.csv"}) {
    CAPTURE(name);
    CHECK((read_file(elsewhere / "second" / name) == read_file(first / name)));
  }
}
