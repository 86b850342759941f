// A load test of a provider that runs in a process of its own.
#include "tests/processes/hosts.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>

using namespace sofof;
using namespace sofof::test;

namespace {

words load_words(std::uint16_t port, const words& more) {
  return words{"load-test",  scenario_file,
               "--provider", "127.0.0.1:" + std::to_string(port),
               "--measure",  "2s"}
         + more;
}

/// The words of the line that begins with this number of vehicles.
std::vector<std::string> load_row(const std::string& table, int vehicles) {
  std::istringstream lines{table};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words{line};
    std::vector<std::string> all{std::istream_iterator<std::string>{words}, {}};
    if (!all.empty() && all.front() == std::to_string(vehicles))
      return all;
  }
  return {};
}

} // namespace

TEST_CASE("a load test tells how well each number of vehicles is served") {
  const workplace at;
  provider_process provider{at, "provider", everywhere(6)};
  program test{load_words(provider.port(),
                          {"--vehicles", "8,4", "--within", "10s", "--set",
                           "policies.codm=always", "--out", "steps"}),
               at.here()};
  const auto end = test.wait();
  INFO(end.err);
  CHECK(end.code == 0);
  for (const auto vehicles : {4, 8}) {
    const auto words = load_row(end.out, vehicles);
    REQUIRE(words.size() == 9);
    CHECK(words[1] == words[0]); // all are served,
    CHECK(std::stod(words[2])
          == doctest::Approx(20 * vehicles).epsilon(0.1)); // 20 times a second
    CHECK(std::filesystem::exists(
        at / "steps" / (std::to_string(vehicles) + "_vehicles/summary.json")));
  }
  CHECK(contains(end.out, "The provider carries 8 vehicles: 99 of 100 results "
                          "come, and within 10000 ms"));
}

TEST_CASE("a load test of a provider that serves nobody says so") {
  const workplace at;
  provider_process provider{at, "provider", {"--set", "policies.codm=never"}};
  program test{load_words(provider.port(), {"--vehicles", "2"}), at.here()};
  const auto end = test.wait();
  CHECK(end.code == 2);
  CHECK(contains(end.err, "none of 2 vehicles was served by the provider at "
                          "127.0.0.1:"));
}
