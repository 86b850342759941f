// How old plans may be.
#pragma once

#include "base/time.hpp"
#include "scenario/scenario.hpp"

namespace sofof::scenario {

/// @returns up to which age a plan is fresh: the longest time between two
/// usable ones. Source: latency limit + gap limit + one planning period.
duration fresh_limit(const scenario_definition& s);

/// @returns after which time without a new plan nobody plans any more. A remote
/// plan was held against the bodies in sight for 2.5 s: braking after a second
/// ends within the way of these, up to some 10 m/s.
duration alone_limit(const scenario_definition& s);

} // namespace sofof::scenario
