// What those who look round on a route know of it.
#include "planners/scene/known_way.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sofof::planners {

known_way::known_way(std::shared_ptr<const lane_network> all,
                     const world::route_ptr& way)
    : lanes{std::move(all)}, legs{way, lanes->meetings()} {
  constexpr auto coarse_m = 4.0;
  const auto& line = way->path();
  const auto count = std::ceil(line.length_m() / coarse_m);
  bead_m = line.length_m() / count;
  assert(bead_m > 0 && bead_m <= coarse_m);
  beads.reserve(static_cast<std::size_t>(count) + 1);
  for (auto i = 0.0; i < count; ++i)
    beads.push_back(line.at(i * bead_m).at);
  if (!way->closed())
    beads.push_back(line.at(line.length_m()).at);
  for (std::size_t i = 0; i < way->sequence().size(); ++i)
    half_lane_m = std::max(half_lane_m, way->half_width_m(way->start_of_m(i)));
  assert(!beads.empty() && half_lane_m > 0);
}

} // namespace sofof::planners
