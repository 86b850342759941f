// Whether a plan of another source may follow the plan in use.
#pragma once

#include "base/geometry.hpp"
#include "base/time.hpp"

#include <span>

namespace sofof::policies {

struct continuity_options {
  duration span = std::chrono::milliseconds{500}; ///< So long they must agree,
  double tolerance_m = 0.3;                       ///< within this.
};

/// Two plans for the same time from now on, at equal times: the first points
/// are of now, each further one a step later.
/// @param in_use   Positions, m.
/// @param offered  Positions by the other source, m.
/// @param step     Time between points, > 0.
/// @returns whether the vehicle may change over to the offered one: over the
/// whole span both are known and no further apart than the tolerance. If not,
/// the source is to be kept.
bool continues(std::span<const point> in_use, std::span<const point> offered,
               duration step, const continuity_options& options = {});

} // namespace sofof::policies
