// Which split of a chain is best.
#pragma once

#include "policies/algorithms/splits/chain_response.hpp"

#include <cstddef>
#include <functional>
#include <span>

namespace sofof::policies {

/// So many splits can be looked at for one decision: of four services over five
/// providers, or of three over nine.
inline constexpr std::size_t most_looked_at = 1296;

/// @returns whether there are no more splits than that.
bool is_few(std::span<const std::vector<service_place>> places);

/// What a split is worth: the less, the better; infinite if it cannot be.
using split_cost = std::function<double(const chain_split&)>;

/// @param places  Where each service may run, at least one place each.
/// @returns the split of the least cost of all; of equal ones the first, by the
/// order of places. O(Π places).
chain_split best_split(std::span<const std::vector<service_place>> places,
                       const split_cost& cost);

/// @returns the split at which moving any single service makes nothing better:
/// from `from` on, the best single move is made again and again.
chain_split greedy_split(std::span<const std::vector<service_place>> places,
                         chain_split from, const split_cost& cost);

} // namespace sofof::policies
