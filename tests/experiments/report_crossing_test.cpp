// What a report says of crossings that are conducted.
#include "experiments/report/crossing_section.hpp"
#include "experiments/report/describe.hpp"
#include "tests/experiments/report_folder.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace sofof::experiments::report {

using namespace made_up;
using test::contains;

namespace {

section crossings_of(const played_folder& folder) {
  for (auto& x : describe_run(folder.path()))
    if (x.title == "Crossings")
      return x;
  return {};
}

} // namespace

TEST_CASE("without claims there is no section on crossings") {
  CHECK(crossings_of(played_folder{}).blocks.empty());
}

TEST_CASE(
    "claims are bars by lane, from entering to leaving; who follows stands "
    "higher") {
  played_folder folder;
  folder.write("claims.csv",
               "station,lane,claimed_s,bound_s,enters_s,leaves_s,kept\n"
               "101,in_e,5,5.25,9,12,1\n"
               "102,in_e,6,6.5,10,13,1\n"
               "103,in_e,8,8.1,20,22,1\n"
               "104,in_n,7,,11,14,0\n");
  const auto all = crossings_of(folder);
  REQUIRE(all.blocks.size() == 2);
  const auto& shown = std::get<figure>(all.blocks[0]);
  REQUIRE(shown.levels.size() == 2);
  CHECK(shown.levels[0].second == "in_e");
  REQUIRE(shown.curves.size() == 3);
  const auto& first = shown.curves[0];
  CHECK(first.name == "in_e");
  CHECK(std::vector(first.x) == std::vector<double>{9, 12, 12, 20, 22, 22});
  CHECK(first.y[0] == shown.levels[0].first);
  CHECK(std::isnan(first.y[2]));
  CHECK(shown.curves[1].y[0] > first.y[0]);
  CHECK(shown.curves[2].dashed);
  CHECK(contains(shown.curves[2].name, "given up"));
  const auto& said = std::get<paragraph>(all.blocks[1]).text;
  CHECK(contains(said, "4 claims: 3 were bound, after 0.50 s at most, 3 were"));
}

} // namespace sofof::experiments::report
