// How a scene message counts: whole numbers of units, in lists that are in
// order.
#pragma once

#include "messages/v2x/scene/scene_message.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sofof::actors::scene_units {

/// Whole numbers of a unit.
struct whole_units {
  double per_si; ///< So many are 1 of SI.

  // What is a whole number but for the rounding of doubles stays the same one.
  static constexpr double same = 1e-6;

  double below(double si) const { return std::floor(si * per_si + same); }
  double above(double si) const { return std::ceil(si * per_si - same); }
  double near(double si) const { return std::floor(si * per_si + 0.5); }
  double si(double units) const { return units / per_si; }
};

inline constexpr whole_units length{100}, lateral{1000}, instant{100};
inline constexpr whole_units lead_speed{100}, lead_accel{100};
inline constexpr whole_units beside_speed{1000}, braking{10};

/// Farther away from the map's origin there is no position, m.
inline constexpr double farthest_m = 100'000;
/// Bodies that move cover for so long what they would without rounding.
inline constexpr double covered_s = 10;
inline constexpr auto never = std::numeric_limits<double>::infinity();

/// Lists are in order. All else that has to hold does by how it is told.
inline bool is_in_order(const messages::scene::content& x) {
  const auto rises = [](const auto& list, auto from) {
    return std::is_sorted(
        list.begin(), list.end(),
        [&](const auto& a, const auto& b) { return from(a) < from(b); });
  };
  return rises(x.crossings, [](const auto& c) { return c.on.from.value; })
         && rises(x.beside, [](const auto& b) { return b.along.from.value; })
         && rises(x.yields, [](const auto& y) { return y.value; })
         && rises(x.keep_free, [](const auto& s) { return s.from.value; });
}

} // namespace sofof::actors::scene_units
