// An assignment found by sampling: a benchmark that knows everything.
#pragma once

#include "policies/algorithms/assignment/cross_entropy.hpp"
#include "policies/algorithms/assignment/problem.hpp"

namespace sofof::policies::assignment {

/// Seeks the best assignment by the cross-entropy method. A vehicle that finds
/// no room in a sample is local there; room is given out in the order of
/// indices.
///
/// Feasible, and never worse than everybody local; with the usual options, one
/// resource and room for 60 %, 6 % from the optimum in the mean and 12 % at
/// worst.
/// @throws std::invalid_argument as check() does.
solution sampled(const problem& p, const cross_entropy_options& options,
                 const random_stream& random);

} // namespace sofof::policies::assignment
