// Which links of a vehicle's chain count for little at a provider without
// another one.
#pragma once

#include "policies/api/context.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace sofof::policies {

/// Indices of requests and then sessions.
using leaning_list = std::vector<std::optional<std::size_t>>;

/// A link leans on the one that it follows if that is asked for with it, or
/// runs at the provider for the same vehicle: without it, its input would come
/// over the air in each cycle, and what the vehicle told of its gain does not
/// hold. What runs leans only on what runs: it did without what is asked for
/// now. All other links stand alone, as their vehicle asks for them without the
/// one that they follow.
/// @returns for each request and then each session on whom it leans; nullopt:
/// it stands alone.
leaning_list leaning_of(const central_context& context);

} // namespace sofof::policies
