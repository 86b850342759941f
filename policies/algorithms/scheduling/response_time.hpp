// How long results of sessions that share workers take: at most, or all but a
// stated share of them.
#pragma once

#include "policies/api/periodic_task.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sofof::policies {

/// Sessions that compute alike.
struct session_group {
  periodic_task task; ///< Offset and, but for `edf`, deadline do not matter.
  std::size_t count = 1;
};

/// Which of the jobs that wait a free worker takes; none is ever interrupted.
enum class queue_order {
  fifo, ///< The one that was released first.
  edf,  ///< The one whose release + deadline comes first.
};

/// The worst-case response time of each group, from a job's release to its end,
/// whatever the phases: sound for every number of workers.
///
/// A job of group i that is released a after the begin of the window in which
/// all m workers are busy with what goes before it starts by the least L with
///
///     m L = c + Σ_j (⌊(min(L, a + D_i − D_j) + J_j) / T_j⌋ + 1) C_j,
///
/// over the sessions with D_j ≤ a + D_i, without the job itself; first come,
/// first served, all D are the same. c is what was under way when the window
/// began: m jobs at most, of which m − 1 at most are due by a + D_i (the others
/// block). With several workers, first come, first served, a session of which a
/// job was under way has fewer others in the window, as that job was released
/// no longer ago than its response.
///
/// O(moments at which a count steps up, of the sessions' window at most).
/// @param workers  m ≥ 1.
/// @returns one for each group; nullopt where Σ C/T ≥ m, or where a window may
/// be longer than 60 s: there is no bound.
/// Source: m = 1: George, Rivierre & Spuri, INRIA RR-2966, 1996 (edf); George &
/// Minet, ICDCS 1997 (fifo); jitter: Spuri, INRIA RR-2772, 1996. m > 1: Guan,
/// Yi, Gu, Deng & Yu, RTSS 2008, with the window of Baruah, RTSS 2007.
std::optional<std::vector<duration>>
worst_case_responses(std::span<const session_group> mix, queue_order order,
                     std::size_t workers);

/// A time that all but a share of results take at most, in the long run.
struct response_quantile {
  duration at_most{};
  double later = 0; ///< The share, ≥ 0; above 1 it says nothing.
};

/// The same, first come, first served, where jobs may compute longer than C
/// (`periodic_task::overrun`). Such a job counts with C, and what it takes
/// beyond, e on average, with all jobs that may wait for it: of D = m − Σ C/T
/// workers that are left, until these have done it. That makes
///
///     R_i = C_i + ((m − 1) max C + Σ_j C_j (1 + J_j/T_j) − C_i) / m,
///     p_i + Σ_j (p_j C_j + e_j (1 + 2/D) + 3 p_j (T_i + J_i)) / T_j
///
/// of how many are later: docs/schedulability.md has the proof. Nothing has to
/// be independent.
/// @returns one for each group; nullopt where Σ C/T ≥ m.
std::optional<std::vector<response_quantile>>
response_quantiles(std::span<const session_group> mix, std::size_t workers);

/// What SOFOF states of a mix: the worst case where no job overruns, which none
/// exceeds, and else the quantiles.
/// @returns one for each group; nullopt if there is no bound.
std::optional<std::vector<response_quantile>>
stated_responses(std::span<const session_group> mix, std::size_t workers);

} // namespace sofof::policies
