// A drive that others rely on, as bounds of a speed plan.
#pragma once

#include "planners/speed/speed_constraints.hpp"

#include <span>

namespace sofof::planners {

/// What was promised binds near its line; everywhere it is what a car wants, so
/// that it comes to the line neither late nor slow.
/// @param from_m    Way of the first knot.
/// @param ds_m      Between knots.
/// @param earliest  s, at knots; raised. `latest` likewise, lowered.
/// @param promised  v²/2 at knots, m²/s²; infinite where nothing was.
void bound_by_promise(const speed_constraints& task, double from_m, double ds_m,
                      std::span<double> earliest, std::span<double> latest,
                      std::span<double> promised);

} // namespace sofof::planners
