// A provider that lies about plans or crossings: what vehicles must survive.
#pragma once

#include "actors/services/service_type.hpp"
#include "base/time.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <string_view>

namespace sofof::experiments::torture {

/// What a provider may say instead of its plan.
enum class lie {
  jump,       ///< It begins 3 m to the left.
  g100,       ///< It drives 160 m/s.
  stale,      ///< It is the first one, for ever.
  ram,        ///< It speeds up by 3.4 m/s² without end.
  mix,        ///< Even stations brake by 6, odd ones speed up by 3.4 m/s².
  offroad,    ///< It leaves the lane to the right.
  oncoming,   ///< It goes over to the opposite lane.
  brake,      ///< It brakes by 9 m/s² for nothing.
  stands,     ///< It stops where lanes cross, and stays there.
  drifts,     ///< It goes to the right by 0.2 m/s, plan by plan.
  swaps,      ///< It is another vehicle's.
  oscillates, ///< It speeds up and brakes in turns.
  replays,    ///< It is an earlier one, with new times.
  through,    ///< It goes on at 8 m/s or more, whoever comes.
};

inline constexpr std::array<std::string_view, 14> lie_names{
    "jump",  "g100",   "stale",  "ram",   "mix",        "offroad", "oncoming",
    "brake", "stands", "drifts", "swaps", "oscillates", "replays", "through"};

/// @returns nullopt for a name that no lie has.
std::optional<lie> lie_of(std::string_view name);

/// @param after  The first results are honest.
/// @returns the service as it is in vehicles, with providers that lie.
actors::service_type_ptr
lying_service(actors::service_type_ptr honest, lie what,
              duration after = std::chrono::seconds{8});

} // namespace sofof::experiments::torture
