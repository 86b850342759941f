// How sure a share is that was counted.
#pragma once

#include "experiments/dehler2025/interval.hpp"

#include <cstdint>

namespace sofof::experiments::study {

/// The exact interval of a share: it holds the truth in at least 95 of 100
/// experiments, whatever the truth is. Without any event its upper end is about
/// 3.7 / of; one-sided, with 95 %, it would be 3 / of, the "rule of three".
/// @param events  Of `of` independent trials, <= of.
/// @param of      >= 1.
/// @returns shares, 0 … 1.
/// Source: Clopper & Pearson, The Use of Confidence or Fiducial Limits
/// Illustrated in the Case of the Binomial, Biometrika 26(4), 1934.
interval share_interval(std::uint64_t events, std::uint64_t of);

} // namespace sofof::experiments::study
