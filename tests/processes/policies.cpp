// Tests of what the program tells of its policies.
#include "tests/processes/hosts.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"

#include <filesystem>
#include <sstream>
#include <utility>

using namespace sofof::test;

namespace {

/// @returns side and name of each that is listed.
std::vector<std::pair<std::string, std::string>>
listed(const std::string& text) {
  std::istringstream lines{text};
  std::vector<std::pair<std::string, std::string>> all;
  std::string side;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  "))
      all.emplace_back(side, line.substr(2, line.find(' ', 2) - 2));
    else
      side = line.substr(0, line.find(','));
  return all;
}

/// @returns the first table with a header, without comments, and without its
/// filter, which may have a table of its own.
std::string table_in(const std::string& text, const std::string& header) {
  const auto begin = text.find(header);
  REQUIRE(begin != text.npos);
  std::istringstream lines{text.substr(begin)};
  std::string table;
  for (std::string line; std::getline(lines, line) && !line.empty();)
    if (!line.starts_with("filter = "))
      table +=
          line.substr(0, line.find_last_not_of(' ', line.find('#') - 1) + 1)
          + '\n';
  return table;
}

/// @returns what makes a scenario use it.
std::string setting(const std::string& side, const std::string& name) {
  if (side == "lodm.filter")
    return "policies.lodm={name=\"nearest\",filter=\"" + name + "\"}";
  if (side == "codm.filter")
    return "policies.codm={name=\"capacity\",filter=\"" + name + "\"}";
  if (side == "lodm.govern")
    return "policies.lodm={name=\"nearest\",govern=[{name=\"" + name + "\"}]}";
  return "policies." + side + "=" + name;
}

} // namespace

TEST_CASE("every policy that is listed is described, and what is said of its "
          "options is what a scenario gets") {
  const workplace at;
  const auto end = at.run_sofof({"policies"});
  CHECK(end.code == 0);
  CHECK(end.err == "");
  const auto all = listed(end.out);
  CHECK(all.size() >= 26);
  for (const auto& [side, name] : all) {
    CAPTURE(side);
    CAPTURE(name);
    const auto told = at.run_sofof({"policies", name}).out;
    const auto begin = told.find(name + " as " + side + ": ");
    REQUIRE(begin != told.npos);
    CHECK(contains(told.substr(begin), "decides by: "));
    CHECK(contains(told.substr(begin), "source: "));
    if (name == "process") // of which there is none by default
      continue;
    const auto header = "[policies." + side + "]";
    const auto check = at.run_sofof(
        {"check", "config/ulm_lehr.toml", "--set", setting(side, name)});
    CHECK(check.code == 0);
    // What ulm_lehr.toml says for itself are the defaults as well.
    CHECK(table_in(told.substr(begin), header) == table_in(check.out, header));
  }
}

TEST_CASE("an option is described beside its default, with unit and range") {
  const workplace at;
  const auto told = at.run_sofof({"policies", "location"}).out;
  CHECK(contains(told,
                 "\nradius_m = 300.0       # m, 0 to 1000000: r_off, of the "
                 "disc round the provider\n"));
  CHECK(contains(told, "\nmin_time = \"5s\"        # from \"0s\": t_min; "));
  CHECK(contains(at.run_sofof({"policies", "assignment"}).out,
                 "\nfilter = \"location\"\n"));
}

TEST_CASE("an unknown policy is refused, and the one meant is named") {
  const workplace at;
  const auto end = at.run_sofof({"policies", "nearst"});
  CHECK(end.code == 2);
  CHECK(end.out == "");
  CHECK(contains(end.err, "did you mean \"nearest\"?"));
}

TEST_CASE("a program that fails as a policy ends a run with exit code 1, one "
          "that there is not with 2, each with a sentence and no results") {
  const workplace at;
  at.write("fails.sh", "read a; echo '{\"sofof\":1,\"name\":\"x\"}'\n"
                       "read a; echo no; read a\n");
  const auto run_by = [&](const std::string& command) {
    return at.run_sofof(
        {"run", "config/ulm_lehr.toml", "--duration", "20s", "--quiet", "--out",
         "out", "--set",
         "policies.lodm={name=\"process\",folder=\"..\",command=\"" + command
             + "\"}"});
  };
  const auto failed = run_by("/bin/sh fails.sh");
  CHECK(failed.code == 1);
  CHECK(contains(failed.err, "\"/bin/sh fails.sh\", answered ask 1 wrongly: it "
                             "must be a JSON object: no\n"));
  CHECK_FALSE(std::filesystem::exists(at / "out"));
  const auto missing = run_by("./no_such");
  CHECK(missing.code == 2);
  CHECK(contains(missing.err, "--set policies.lodm"));
  CHECK_FALSE(std::filesystem::exists(at / "out"));
}

TEST_CASE("what a policy has learned is in a file of its own name, unless "
          "another is asked for") {
  const workplace at;
  const words short_drive{"train",      "config/bench/single_intersection.toml",
                          "--quiet",    "--policy",
                          "q_learning", "--seeds",
                          "1",          "--set",
                          "duration=5s"};
  const auto first = at.run_sofof(short_drive);
  CHECK(first.code == 0);
  CHECK(contains(first.out, "snapshot in q_learning.txt"));
  CHECK(std::filesystem::exists(at / "q_learning.txt"));
  CHECK(at.run_sofof(short_drive + words{"--out", "mine.txt"}).code == 0);
  CHECK(read_file(at / "mine.txt") == read_file(at / "q_learning.txt"));
}
