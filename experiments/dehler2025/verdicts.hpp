// The section that says what became of the paper's claims.
#pragma once

#include "experiments/dehler2025/claims.hpp"
#include "experiments/report/document.hpp"

#include <span>

namespace sofof::experiments::study {

/// A table with a line for each claim: what the paper says, when that counts as
/// reproduced, our figures, and the verdict.
report::section verdicts(std::span<const judged_claim> claims);

} // namespace sofof::experiments::study
