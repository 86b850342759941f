// How long a job waits at a busy provider, and how busy it may be.
#pragma once

#include "base/time.hpp"

#include <optional>

namespace sofof::policies::assignment {

/// Mean wait before service at one core: Poisson arrivals, equal jobs, first
/// come first served (M/D/1).
///
///   W(ρ) = ρ S / (2 (1 − ρ))
///
/// @param service_time  S ≥ 0.
/// @param utilisation   ρ ≥ 0, the share of time in which the core is busy.
/// @returns nullopt from ρ = 1 on: the queue grows without end.
/// Source: Pollaczek–Khinchine formula, e.g. Kleinrock, Queueing Systems 1
/// (1975), section 5.6.
std::optional<duration> mean_wait(duration service_time, double utilisation);

/// How much of its time a provider may be busy so that jobs wait no longer than
/// allowed in the mean; the wait becomes a linear constraint of the assignment.
///
///   U = cores · 2 w* / (S + 2 w*)
///
/// Each core is counted with a queue of its own: a shared queue waits less.
/// @param cores         ≥ 0.
/// @param service_time  S > 0.
/// @param allowed_wait  w* ≥ 0.
/// @returns a number of busy cores, < cores.
double utilisation_cap(int cores, duration service_time, duration allowed_wait);

} // namespace sofof::policies::assignment
