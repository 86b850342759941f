// When which vehicle is on which part of a crossing.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"

#include <cstdint>
#include <vector>

namespace sofof::planners {

/// A time that a vehicle has a conflict area for itself.
struct area_window {
  std::uint32_t area = 0; ///< A number that all vehicles know it by.
  time_point from, to;

  friend bool operator==(const area_window&, const area_window&) = default;
};

/// @param apart  What has to lie between two windows, >= 0.
/// @returns whether two windows of one area overlap.
inline bool overlap(const area_window& a, const area_window& b,
                    duration apart = {}) {
  return a.area == b.area && a.from < b.to + apart && b.from < a.to + apart;
}

/// What a vehicle tells everybody who hears it: all that it claims.
struct area_claims {
  station_id who = 0;
  time_point generated; ///< By its own clock, as its windows.
  std::vector<area_window> windows;
};

} // namespace sofof::planners
