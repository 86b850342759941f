// Files and commands of before, whose options have moved since.
#include "tests/processes/workplace.hpp"

using namespace sofof::test;

namespace {

std::size_t lines_with(std::string_view what, std::string_view text) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

constexpr auto sweep_of_workers = R"(name = "servers"
scenario = "config/ulm_lehr.toml"

[set]
duration = "1s"
fleet.0.count = 1

[[axis]]
key = "network.workers"
values = [1, 2, 3]
)";

} // namespace

TEST_CASE("an option at its old place counts, and is noted once") {
  const workplace at;
  const auto end = at.run_sofof(
      {"check", scenario_file, "--set", "network.workers=3", "--set",
       "service.0.run_time_mean=6ms", "--set", "service.1.run_time_mean=7ms"});
  CHECK(end.code == 0);
  CHECK(end.out.find("workers = 3\n") != end.out.npos);
  CHECK(end.out.find("run_time_mean = \"6ms\"\n") != end.out.npos);
  CHECK(end.out.find("run_time_mean = \"7ms\"\n") != end.out.npos);
  CHECK(lines_with("sofof: --set ", end.err) == 2);
  CHECK(end.err.starts_with(
      "sofof: --set network.workers=3: network.workers is compute.workers"));
  CHECK(lines_with("compute.run_time_mean", end.err) == 1);
}

TEST_CASE("a sweep over an option at its old place notes that once") {
  const workplace at;
  at.write("servers.toml", sweep_of_workers);
  const auto end = at.run_sofof({"sweep", "servers.toml", "--out", "out"});
  CAPTURE(end.err);
  CHECK(end.code == 0);
  CHECK(end.out.find("3 good, 0 unsafe, 0 failed") != end.out.npos);
  CHECK(lines_with("network.workers is compute.workers", end.err) == 1);
  CHECK(lines_with("\n", end.err) == 1);
}

TEST_CASE("an option at both places is refused with both") {
  const workplace at;
  auto text = read_file(at / scenario_file);
  const std::string_view network = "\n[network]\n";
  text.insert(text.find(network) + network.size(), "workers = 2\n");
  at.write(scenario_file, text + "\n[compute]\nworkers = 2\n");
  const auto end = at.run_sofof({"check", scenario_file});
  CHECK(end.code == 2);
  CHECK(end.out == "");
  CHECK(end.err.find("network.workers stands at its new place")
        != end.err.npos);
  CHECK(lines_with("config/ulm_lehr.toml:", end.err) == 2);
  CHECK(lines_with("\n", end.err) == 1);
}
