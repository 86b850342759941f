// The section that says what became of the paper's claims.
#pragma once

#include "experiments/dehler2025/claims.hpp"
#include "experiments/report/document.hpp"

#include <span>

namespace sofof::experiments::study {

/// A table with a line for each claim: the verdict, our figures, what the paper
/// says, and when that counts as reproduced.
report::section verdicts(std::span<const judged_claim> claims);

} // namespace sofof::experiments::study
