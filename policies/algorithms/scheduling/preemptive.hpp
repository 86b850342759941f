// How long functions that share cores and interrupt each other take at most.
#pragma once

#include "base/core_order.hpp"
#include "policies/api/periodic_task.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sofof::policies {

/// The worst-case response time of each function, from a job's release to its
/// end, on one core that interrupts jobs for more urgent ones, whatever the
/// phases. A function has one job at a time: what would come while one is under
/// way is released when that is done, and counts as a release in the jitter.
///
/// By fixed priorities it is the least w with
///
///     w = C_i + Σ_j ⌈(w + J_j) / T_j⌉ C_j,
///
/// over the functions before it, whatever it comes to itself.
///
/// By deadlines, release + D, a job of function i that is released a after the
/// begin of the window in which the core computes nothing that is due later is
/// done within that window, which is no longer than L, the least with
///
///     L = n_i C_i + Σ_j min(⌈(L + J_j) / T_j⌉, n_j) C_j,
///     n_j = ⌊(x_j + J_j) / T_j⌋ + 1,  x_j = a + D_i − D_j,
///
/// over all with x_j ≥ 0, and no longer than Σ C_j + E: all n_j jobs but the
/// last are done by x_j, so that of (n_j − 1) C_j no more counts in E than fits
/// before x_j, with those of lesser x_j. The response is the longest L − a.
///
/// @param tasks  By fixed priorities the most urgent first. Offsets and
///               overruns do not matter.
/// @returns one for each; nullopt where nothing is left of the core for it, or
/// where a window may be longer than 60 s: there is no bound.
/// Source: fixed priorities: Joseph & Pandya, The Computer Journal, 1986;
/// jitter: Audsley, Burns, Richardson, Tindell & Wellings, Software Engineering
/// Journal, 1993; edf: Spuri, INRIA RR-2772, 1996.
std::vector<std::optional<duration>>
preemptive_responses(std::span<const periodic_task> tasks, core_order order);

/// Shares functions out to cores, which they then never leave: those that take
/// most first, each to the core with the least load, the first of equals.
/// @param cores  >= 1.
/// @returns the core of each.
std::vector<std::size_t> share_out(std::span<const periodic_task> tasks,
                                   std::size_t cores);

} // namespace sofof::policies
