// When services of vehicles ran at providers.
#pragma once

#include "experiments/report/recorded_run.hpp"

#include <span>
#include <vector>

namespace sofof::experiments::report {

/// A time in which a service of a vehicle ran at a provider.
struct offloading_span {
  session_key of;
  double from_s = 0;
  double until_s = 0;
};

/// @param events  Of this run.
/// @param end_s   Ends what nobody has ended.
/// @returns what vehicles have used, by their changes of source; where no
/// vehicle has written any, what providers have served.
std::vector<offloading_span> offloadings_of(const recorded_run& run,
                                            std::span<const event_line> events,
                                            double end_s);

} // namespace sofof::experiments::report
