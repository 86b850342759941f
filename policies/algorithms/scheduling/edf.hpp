// Whether one core can keep all deadlines, earliest deadline first.
#pragma once

#include "policies/api/periodic_task.hpp"

namespace sofof::policies {

/// Necessary always, enough only where every deadline is as long as its period
/// and nothing jitters. Looks at no offsets. O(tasks).
/// @returns whether Σ C/T ≤ 1, but for rounding.
/// Source: Liu & Layland 1973.
bool fits_by_utilisation(std::span<const periodic_task> tasks);

/// The processor demand test: for every deadline t up to the end of the busy
/// period, all that is due by then fits before it,
///
///     Σ_j (⌊(t − (D_j − J_j)) / T_j⌋ + 1) C_j ≤ t,
///
/// over the tasks with D_j − J_j ≤ t. Exact, in whole nanoseconds, for
/// preemptive earliest deadline first if tasks may be released together: tasks
/// without phases. Looks at no offsets. A busy period above 60 s is refused
/// unseen; only a core without any reserve has one.
/// O(tasks · deadlines in the busy period).
/// @returns whether all deadlines are kept.
/// Source: Baruah, Rosier & Howell 1990; jitter: Spuri 1996.
bool fits_by_demand(std::span<const periodic_task> tasks);

} // namespace sofof::policies
