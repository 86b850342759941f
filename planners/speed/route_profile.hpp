// What planners look up of a route.
#pragma once

#include "planners/scene/reference_line.hpp"
#include "planners/speed/speed_envelope.hpp"

#include <memory>
#include <utility>

namespace sofof::planners {

/// A route as it is sampled, and how fast it may be driven. It takes
/// milliseconds to compute and never changes: all planners share one.
struct route_profile {
  route_profile(world::route_ptr way, const comfort_limits& style,
                const route_sight* sight = nullptr,
                const lane_network* lanes = nullptr)
      : line{std::move(way)}, envelope{line.way(), style, sight, lanes} {}

  reference_line line;
  speed_envelope envelope;
};

using route_profile_ptr = std::shared_ptr<const route_profile>;

} // namespace sofof::planners
