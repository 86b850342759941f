// Messages that Foxglove and Lichtblick know, as JSON.
#pragma once

#include "base/geometry.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace sofof::experiments::convert::foxglove {

/// A message's name, and what it consists of (JSON Schema). The names are those
/// of Foxglove's schemas, docs.foxglove.dev/docs/sdk/schemas; those of
/// `sofof.` are our own.
struct schema {
  std::string_view name;
  std::string_view json;
};

extern const schema frame_transforms, scene_update, location_fix, log_message,
    geo_json, vehicle_state, offloading_result;

using colour = std::array<double, 4>; ///< Red, green, blue, opacity; 0 to 1.

/// A place and a direction on the ground.
struct pose {
  point at; ///< m.
  double heading_rad = 0;
};

/// A frame that moves with a car.
std::string transform(std::uint64_t unix_ns, std::string_view frame,
                      const pose& of);

/// A box on the ground.
struct box {
  pose middle;
  double length_m = 0, width_m = 0, height_m = 0;
  colour paint{};
};

/// What belongs together in a scene: boxes and lines, replaced as one by the
/// next of the same id.
struct entity {
  std::string_view id;
  double lifetime_s = 0; ///< 0: for ever.
  std::span<const box> boxes{};
  struct line {
    std::span<const point> points;
    double width_m = 0;
    colour paint{};
    bool is_closed = false;
  };
  std::span<const line> lines{};
};

std::string scene(std::uint64_t unix_ns, std::span<const entity> entities);

std::string location(std::uint64_t unix_ns, double latitude_deg,
                     double longitude_deg);

enum class level { debug = 1, info, warning, error };

std::string log(std::uint64_t unix_ns, level how, std::string_view name,
                std::string_view text);

} // namespace sofof::experiments::convert::foxglove
