// The life of a service instance, in the terms of ROS 2 lifecycle nodes.
#pragma once

#include "messages/protocol/inspect.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

namespace sofof::messages {

enum class lifecycle_state : std::uint8_t {
  unconfigured,
  inactive,
  active,
  finalized,
};

enum class lifecycle_step : std::uint8_t {
  configure,  ///< unconfigured → inactive
  activate,   ///< inactive → active
  deactivate, ///< active → inactive
  shut_down,  ///< any but finalized → finalized
};

constexpr lifecycle_step last_of(lifecycle_step) {
  return lifecycle_step::shut_down;
}

inline constexpr std::string_view name_of(lifecycle_state state) {
  constexpr std::string_view names[] = {"unconfigured", "inactive", "active",
                                        "finalized"};
  return names[static_cast<std::size_t>(state)];
}

/// @returns the state after a step; nullopt where the step is not possible.
constexpr std::optional<lifecycle_state> after(lifecycle_state from,
                                               lifecycle_step step) {
  using enum lifecycle_state;
  using enum lifecycle_step;
  if (step == configure && from == unconfigured)
    return inactive;
  if (step == activate && from == inactive)
    return active;
  if (step == deactivate && from == active)
    return inactive;
  if (step == shut_down && from != finalized)
    return finalized;
  return std::nullopt;
}

} // namespace sofof::messages
