// The paper's evaluation as its users start it, made small.
#include "tests/processes/workplace.hpp"

#include <csignal>
#include <regex>

using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

/// One seed, a minute, few limits.
void make_small(const fs::path& file) {
  auto text = read_file(file);
  const auto change = [&text](const char* what, const char* to) {
    text = std::regex_replace(text, std::regex{what}, to);
  };
  change("most_seeds = \\[[^\\]]*\\]", "most_seeds = 1");
  change("seeds = [0-9]+", "seeds = 1");
  change("values = \\[\\s*\"10ms\"[^\\]]*\\]",
         "values = [\"80ms\", \"150ms\"]");
  change("duration = \"1[58]0s\"", "duration = \"60s\"");
  change("duration = \"20s\"", "duration = \"14s\"");
  std::ofstream{file} << text;
}

} // namespace

TEST_CASE("the paper's evaluation becomes one page and one text") {
  const workplace at;
  for (const auto& file : fs::directory_iterator{at / "config/paper"})
    if (file.is_regular_file())
      make_small(file.path());
  const auto end = at.run_sofof({"reproduce", "--out", "paper"});
  CAPTURE(end.err);
  CAPTURE(end.out);
  REQUIRE(end.code == 0);
  CHECK(end.out.find("report in paper/report.html") != end.out.npos);
  const auto text = read_file(at / "paper/reproduction.md");
  for (const auto* part :
       {"# The paper's evaluation, reproduced", "## Verdicts", "| cost_20_hz |",
        "## Offloading time", "## Latency", "## Real drives",
        "## Computing time", "## Quality of the offloaded result",
        "10.54 ± 9.83", "8.73 %",
        "Means over all episodes of one run of 60 s for each point",
        "5 wall-clock runs of 14 s each"})
    CHECK(text.find(part) != text.npos);
  CHECK(text.find('{') == text.npos);
  CHECK(read_file(at / "paper/report.html").find("</html>")
        != std::string::npos);
}

TEST_CASE(
    "the whole evaluation says how many hours it takes before it begins") {
  const workplace at;
  for (const auto& file : fs::directory_iterator{at / "config/paper"})
    if (file.is_regular_file())
      make_small(file.path());
  program run{{"reproduce", "--full", "--out", "paper"}, at.here()};
  const std::regex said{"at most [0-9]+ runs, [0-9.]+ hours with [0-9]+ at a "
                        "time, as one of them took [0-9.]+ s"};
  REQUIRE(wait_until(
      [&] { return !run.runs() || std::regex_search(run.printed(), said); }));
  REQUIRE(run.runs());
  CHECK_FALSE(fs::exists(at / "paper/reproduction.md"));
  run.send(SIGINT);
  CHECK(run.wait().code == 130);
}

TEST_CASE("a folder that is not the paper's is refused with a sentence") {
  const workplace at;
  const auto end = at.run_sofof({"reproduce", "config", "--out", "paper"});
  CHECK(end.code == 2);
  CHECK(end.err
        == "sofof: config/latency_plot.toml: this file cannot be read: No such "
           "file or directory.\n");
}
