// What the command says of itself, and of words that it does not know.
#include "tests/processes/workplace.hpp"
#include "tests/support/contains.hpp"

using namespace sofof::test;

TEST_CASE("wrong usage is refused") {
  const workplace at;
  const auto before = at.inventory();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run"},
        {"check"},
        {"drive"},
        {"--fast"},
        {"run", scenario_file, "--fast"},
        {"run", scenario_file, "another.toml"},
        {"run", scenario_file, "--seed"},
        {"check", scenario_file, "--force"}}) {
    CAPTURE(words);
    const auto end = at.run_sofof(words);
    CHECK(end.code == 2);
    CHECK(end.out == "");
    CHECK(contains(end.err, "--help"));
  }
  CHECK(at.inventory() == before);
}

TEST_CASE("a command that is misspelt is told which one is meant") {
  const workplace at;
  const auto end = at.run_sofof({"drvie", scenario_file});
  CHECK(end.code == 2);
  CHECK(end.out == "");
  CHECK(contains(end.err, "did you mean \"drive\"?"));
}

TEST_CASE("help is everywhere, and has an example") {
  const workplace at;
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--help"},
        {"-h"},
        {"run", "--help"},
        {"check", "--help"}}) {
    CAPTURE(words);
    const auto end = at.run_sofof(words);
    CHECK(end.code == 0);
    CHECK(end.err == "");
    CHECK(contains(end.out, "Usage: sofof"));
    CHECK(contains(end.out, "\n  sofof run config/")
          != contains(end.out, "\n  sofof check config/"));
  }
}

TEST_CASE("no arguments print the help") {
  const workplace at;
  const auto end = at.run_sofof({});
  CHECK(end.code == 0);
  CHECK(end.err == "");
  CHECK(end.out == at.run_sofof({"--help"}).out);
}

TEST_CASE("the version is one line") {
  const workplace at;
  const auto end = at.run_sofof({"--version"});
  CHECK(end.code == 0);
  CHECK(end.err == "");
  CHECK(end.out.starts_with("sofof "));
  CHECK(end.out.find('\n') + 1 == end.out.size());
}
