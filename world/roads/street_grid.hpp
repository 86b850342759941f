// A made-up town: streets in a grid, for experiments with many vehicles.
#pragma once

#include "base/options/option_visitor.hpp"
#include "world/roads/streets.hpp"

#include <cstdint>

namespace sofof::world {

/// Junction (c, r) stands at (c, r) times the length of a block, m; junction
/// (0, 0) is the south-west corner. The defaults give 115 km of street lanes
/// and 73 km of ways over junctions.
struct street_grid_params {
  std::int64_t columns = 16;  ///< Junctions from west to east, 2 to 64.
  std::int64_t rows = 16;     ///< Junctions from south to north, 2 to 64.
  double block_m = 150;       ///< Between neighbouring junctions, 60 to 1000.
  double limit_mps = 13.89;   ///< Everywhere, 3 to 30.
  double half_width_m = 1.75; ///< Half a lane, 1.5 to 2.5.

  static constexpr option_visitor::range sizes{2, 64}, blocks_m{60, 1000},
      limits_mps{3, 30}, half_widths_m{1.5, 2.5};

  void visit_options(option_visitor& s) {
    s.field("columns", columns, sizes);
    s.field("rows", rows, sizes);
    s.field("block_m", block_m, blocks_m);
    s.field("limit_mps", limit_mps, limits_mps);
    s.field("half_width_m", half_width_m, half_widths_m);
  }
};

/// Builds two-way streets between all neighbouring junctions, right-hand
/// traffic, and a connector for every way over a junction but turning back.
/// East-west streets have the right of way; left turns yield (ranks: 0 along
/// an east-west street, 1 turning left from it, 2 and 3 from a north-south
/// one).
///
/// Lanes are named after the junction that they leave and where they head
/// ("3.4e" leads east from column 3, row 4), connectors after their junction
/// and both headings ("4.4e>s"). The routes are closed: clockwise round each
/// block, named after its south-west junction ("block 3.4"), and among them
/// rectangles of several blocks that go straight over junctions, most of them
/// clockwise ("tour 17").
/// @throws std::invalid_argument when a parameter is out of its range.
streets_ptr make_street_grid(const street_grid_params& params);

} // namespace sofof::world
