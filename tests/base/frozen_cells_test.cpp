// Tests of a grid of cells that stays as it is.
#include "base/frozen_cells.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

using namespace sofof;
using namespace sofof::test;

TEST_CASE("frozen cells have what their grid has in each cell, in its order") {
  dice random{12};
  for (const auto count : {0, 1, 40, 3000}) {
    CAPTURE(count);
    cell_grid grid{7};
    const auto anywhere = [&random] {
      return point{random.between(-400, 400), random.between(-400, 400)};
    };
    for (auto k = 0; k < count; ++k) {
      const auto from = anywhere();
      const auto to =
          from + point{random.between(-9, 9), random.between(-9, 9)};
      grid.add(from, to, random.between(0, 3), static_cast<cell_grid::item>(k));
    }
    const frozen_cells<int> frozen{
        grid, [](cell_grid::item i) { return 10 * static_cast<int>(i); }};
    for (auto k = 0; k < 5000; ++k) {
      const auto p = anywhere();
      std::vector<int> expected;
      grid.for_each_near(p, 0, [&expected](cell_grid::item i) {
        expected.push_back(10 * static_cast<int>(i));
      });
      const auto found = frozen.at(p);
      CHECK(std::vector<int>(found.begin(), found.end()) == expected);
    }
  }
}

TEST_CASE("nothing is in frozen cells far off, nowhere, or of no grid") {
  cell_grid grid{7};
  grid.add({0, 0}, {1, 1}, 0, 3);
  const frozen_cells<int> frozen{
      grid, [](cell_grid::item i) { return static_cast<int>(i); }};
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto p : {point{1e300, 0}, point{0, -1e300}, point{nan, nan}}) {
    CHECK(frozen.at(p).empty());
    CHECK(frozen_cells<int>{}.at(p).empty());
  }
  CHECK(frozen.at({0.5, 0.5}).size() == 1);
}
