// Seeds by need: more runs where few leave a figure uncertain.
#pragma once

#include "experiments/dehler2025/measured_run.hpp"
#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/sweep/plan.hpp"
#include "experiments/sweep/sweep.hpp"

#include <atomic>
#include <span>

namespace sofof::experiments::study {

/// Doubles the seeds of each combination of values that needs more runs, up to
/// `most_seeds` of the plan, `rule.times` over. What was decided once is never
/// taken back, so the same runs lead to the same seeds, in whatever order they
/// were made.
/// @param runs  Of the plan as it is.
/// @returns whether any got more; never for a plan without `most_seeds`.
bool add_seeds(sweep_plan& plan, std::span<const measured_run> runs,
               const seed_rule& rule);

/// Adds seeds as long as all runs of a plan are there.
/// @param options  Where runs lie; nothing is made.
/// @returns the plan whose runs are to be made next; of one that is finished,
///          the whole plan.
/// @throws input_error when no point can be loaded, or a run is broken.
sweep_plan next_round(sweep_plan plan, const sweep_options& options,
                      const seed_rule& rule,
                      const std::atomic<bool>& interrupted);

} // namespace sofof::experiments::study
