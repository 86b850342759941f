// The weights of a cycle's cost as options of those who go by it.
#pragma once

#include "base/options/option_visitor.hpp"
#include "policies/api/gain.hpp"
#include "policies/api/notes.hpp"

#include <vector>

namespace sofof::policies {

/// Lists λ_T, λ_E and λ_V.
void list_weights(option_visitor& s, cost_weights& weights);

/// @returns what is said of them, then `others`.
std::vector<option_info> weights_and(const std::vector<option_info>& others);

} // namespace sofof::policies
