// When in the period each session of a core is to compute.
#pragma once

#include "policies/api/periodic_task.hpp"

#include <optional>

namespace sofof::policies {

/// Plays preemptive earliest deadline first of tasks with offsets on one core,
/// with every job released as late as its jitter allows, which is the worst
/// case, over all that can happen: the last offset and two hyperperiods.
/// @param tasks  With 0 ≤ offset and periods whose least common multiple is at
///               most 1 s.
/// @returns the longest time that a job lies idle between its release and its
/// result; nullopt if a deadline is broken, or the periods' multiple is longer.
/// Source of the horizon: Leung & Merrill 1980.
std::optional<duration> longest_wait(std::span<const periodic_task> tasks);

/// Looks for the offset of a further session on a core whose sessions keep
/// theirs: of the moments at which one of them would be done (and 0), that with
/// the least `longest_wait` of all sessions; the earliest of equals. Where the
/// core has an idle stretch of C in every period it finds one without any
/// waiting; where all idle stretches are shorter it may miss a way to overlap
/// that another offset would allow.
/// O(moments · jobs · log tasks), with the jobs of two hyperperiods: some 16 µs
/// for 12 sessions of 50 and 100 ms, 10 ms for 34 of 40 ms and 1 s.
/// @param running  Sessions of the core with their offsets.
/// @param task     Its own offset does not matter.
/// @returns the offset in [0, T); nullopt if some deadline would be broken.
std::optional<duration> assigned_offset(std::span<const periodic_task> running,
                                        const periodic_task& task);

} // namespace sofof::policies
