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

TEST_CASE(
    "what is wrong with the words is one sentence with the option meant") {
  const workplace at;
  struct wrong {
    std::vector<std::string> words;
    std::string says;
  };
  for (const auto& [words, says] :
       {wrong{{"run", scenario_file, "--duraton", "5s"},
              "sofof: \"--duraton\" is no option of sofof run, did you mean "
              "\"--duration\"? sofof run --help lists them.\n"},
        wrong{{"run", scenario_file, "another.toml"},
              "sofof: \"another.toml\" is one word too many; sofof run --help "
              "tells how it is called.\n"},
        wrong{{"run"},
              "sofof: FILE is required; sofof run --help tells more.\n"},
        wrong{{"run", scenario_file, "--seed"},
              "sofof: --seed needs a value; sofof run --help tells more.\n"},
        wrong{{"--fast"},
              "sofof: \"--fast\" is no option of sofof. sofof --help lists "
              "them.\n"}}) {
    CAPTURE(words);
    const auto end = at.run_sofof(words);
    CHECK(end.code == 2);
    CHECK(end.out == "");
    CHECK(end.err == says);
  }
}

TEST_CASE("help is a command, too") {
  const workplace at;
  CHECK(at.run_sofof({"help"}).out == at.run_sofof({"--help"}).out);
  CHECK(at.run_sofof({"help", "run"}).out
        == at.run_sofof({"run", "--help"}).out);
  CHECK(contains(at.run_sofof({"help", "rnu"}).err, "did you mean \"run\"?"));
}

TEST_CASE("a scenario is found by its name, or the nearest one is named") {
  const workplace at;
  for (const auto* name : {"ulm_lehr", "ulm_lehr.toml"}) {
    const auto end = at.run_sofof({"check", name});
    CHECK(end.code == 0);
    CHECK(end.err.starts_with("sofof: taking config/ulm_lehr.toml\n"));
    CHECK(end.out == at.run_sofof({"check", "config/ulm_lehr.toml"}).out);
  }
  for (const auto* name :
       {"ulm_leer", "ulm_leer.toml", "config/ulm_leer.toml"}) {
    CAPTURE(name);
    const auto end = at.run_sofof({"check", name});
    CHECK(end.code == 2);
    CHECK(contains(end.err, "did you mean config/ulm_lehr.toml?"));
  }
  CHECK(contains(at.run_sofof({"check", "nothing_like_it"}).err,
                 "cannot be read: No such file or directory."));
}

TEST_CASE("a map is no scenario, and called a map") {
  const workplace at;
  const auto end = at.run_sofof({"check", "config/maps/ulm_lehr.toml"});
  CHECK(end.code == 2);
  CHECK(end.err
        == "sofof: config/maps/ulm_lehr.toml: this is a map; name a scenario "
           "that says `map = \"ulm_lehr.toml\"`.\n");
}

TEST_CASE("an element that a list lacks is said with those that it has") {
  const workplace at;
  CHECK(contains(
      at.run_sofof({"check", scenario_file, "--set", "provider.mce.range_m=3"})
          .err,
      "there is no \"mce\", did you mean \"mec\"? Known: mec."));
}
