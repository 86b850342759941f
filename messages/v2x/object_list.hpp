// What stations tell of bodies that they see, whatever the message.
#pragma once

#include "base/geometry.hpp"
#include "base/ids.hpp"
#include "base/time.hpp"
#include "world/sensing/perception.hpp"
#include "world/sensing/viewpoint.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sofof::messages {

/// What a station tells of bodies that it sees.
struct object_list {
  station_id from = 0;
  time_point at;
  std::vector<world::perceived_object> objects;
  /// Of each object: its number, the same as long as the station knows it; none
  /// where they have no such numbers, and all that is seen is told.
  std::vector<std::uint32_t> ids{};
  std::size_t perceived = 0; ///< All objects, those that it does not tell too.
  time_point generated{};    ///< When the station was where it says it is.
  /// From the middle of its front; range 0: it does not tell of its sensors,
  /// or of more than one. None: it does not say which way it heads.
  std::optional<world::viewpoint> eye{};
};

/// A body as it was at a time of its own.
struct timed_object {
  time_point at;
  world::perceived_object what;
  std::uint32_t id = 0;
};

/// @returns all objects, moved on at constant speed to the time of the last
/// of them.
/// @param generated  The time for no objects.
object_list brought_together(station_id from, time_point generated,
                             std::span<const timed_object> objects);

/// @returns whether a body has a size; others cannot be dealt with.
inline bool has_size(const world::perceived_object& x) {
  constexpr double least_m = 0.05; // messages tell 0.1 m
  return x.length_m > least_m && x.width_m > least_m;
}

inline point unit_vector(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

/// A quantity of messages/etsi/units.hpp as the number of a field.
template <class Number>
Number wire(const auto& quantity, double si) {
  return static_cast<Number>(quantity.to_wire(si));
}

} // namespace sofof::messages
