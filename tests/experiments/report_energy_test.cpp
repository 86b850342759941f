// What a report says of the energy of both ends.
#include "experiments/report/describe.hpp"
#include "tests/experiments/report_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sofof::experiments::report {

using namespace made_up;

namespace {

const section* energy_in(const std::vector<section>& all) {
  const auto found =
      std::ranges::find(all, "Energy of both ends", &section::title);
  return found == all.end() ? nullptr : &*found;
}

/// The played run with two splits.
struct split_folder : played_folder {
  explicit split_folder(double server_j) {
    spoil("summary.json", "\"load\": {}",
          fmt::format("\"splits\": {{\"trajectory_planning\": {{"
                      "\"vehicle\": {{\"driven_s\": 10.5, \"server_j\": 0}}, "
                      "\"mec\": {{\"driven_s\": 4, \"server_j\": {}, "
                      "\"saved_j\": -0.5, \"break_even_w\": null}}}}}}, "
                      "\"load\": {{}}",
                      server_j));
  }
};

} // namespace

TEST_CASE("each split has a row of what it took and saved") {
  const split_folder folder{1.25};
  const auto all = describe_run(folder.path());
  const auto* energy = energy_in(all);
  REQUIRE(energy);
  REQUIRE(energy->blocks.size() == 1);
  const auto& splits = std::get<table>(energy->blocks.front());
  REQUIRE(splits.rows.size() == 2);
  CHECK(splits.rows[0]
        == std::vector<std::string>{"trajectory_planning", "mec", "4.0", "–",
                                    "–", "1.25", "–", "-0.50", "–", "–"});
  CHECK(splits.rows[1][1] == "vehicle");
  for (const auto& meaning : splits.column_meanings)
    CHECK(meaning != "");
}

TEST_CASE("where nothing was offloaded there is no table of energy") {
  CHECK_FALSE(energy_in(describe_run(split_folder{0}.path())));
  CHECK_FALSE(energy_in(describe_run(played_folder{}.path())));
}

} // namespace sofof::experiments::report
