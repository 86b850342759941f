// Drawing one of several, for policies that do so.
#pragma once

#include "policies/api/context.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace sofof::policies {

/// @param lane   Tells the draws of one decision apart.
/// @param count  At least 1.
/// @returns a number below it; the same for the same draw.
inline std::size_t drawn_place(const local_context& context, std::uint32_t lane,
                               std::size_t count) {
  assert(count >= 1);
  const auto place =
      context.noise.uniform(context.number, lane) * static_cast<double>(count);
  return std::min(static_cast<std::size_t>(place), count - 1);
}

} // namespace sofof::policies
