// The episodes of a run, one a row.
#pragma once

#include "experiments/report/document.hpp"
#include "experiments/report/recorded_run.hpp"

namespace sofof::experiments::report {

/// @returns episodes as the vehicles closed them; where no vehicle ran, as the
/// provider did; columns of episodes.csv that the report does not know follow
/// as they are. No title.
table episode_table(const recorded_run& run);

} // namespace sofof::experiments::report
