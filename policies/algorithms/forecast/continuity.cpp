// Whether a plan of another source may follow the plan in use.
#include "policies/algorithms/forecast/continuity.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::policies {

bool continues(std::span<const point> in_use, std::span<const point> offered,
               duration step, const continuity_options& options) {
  assert(step > duration{0});
  // The last point at the end of the span or, off the grid, after it.
  const auto steps = (options.span + step - duration{1}) / step;
  const auto count = static_cast<std::size_t>(steps) + 1;
  if (in_use.size() < count || offered.size() < count)
    return false;
  return std::ranges::equal(in_use.first(count), offered.first(count),
                            [&](point a, point b) {
                              return distance_m(a, b) <= options.tolerance_m;
                            });
}

} // namespace sofof::policies
