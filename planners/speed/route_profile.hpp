// What planners look up of a route.
#pragma once

#include "planners/scene/reference_line.hpp"
#include "planners/speed/speed_envelope.hpp"

#include <memory>
#include <span>
#include <utility>

namespace sofof::planners {

/// A route as it is sampled, and how fast it may be driven. It takes
/// milliseconds to compute and never changes: all planners share one.
struct route_profile {
  /// @param most_mps  As in `reference_line`.
  route_profile(world::route_ptr way, const comfort_limits& style,
                std::span<const double> most_mps = {})
      : line{std::move(way), most_mps}, envelope{line.way(), style, most_mps} {}

  reference_line line;
  speed_envelope envelope;
};

using route_profile_ptr = std::shared_ptr<const route_profile>;

} // namespace sofof::planners
