// Where vehicles on two ways would touch: how far one must have come before the
// other may go on.
#pragma once

#include "base/geometry.hpp"
#include "world/roads/path.hpp"

#include <limits>
#include <vector>

namespace sofof::world {

/// A part of a path, arc lengths, m.
struct path_stretch {
  const path* on = nullptr;
  double from_m = 0, to_m = 0;
};

/// A body that moves along a path with its middle on it.
struct moving_body {
  double length_m = 0, width_m = 0; ///< With whatever is to be kept off it.
};

/// For each place of a second body, how far a first one that goes before it
/// must have come, so that the two do not touch there nor anywhere before.
/// Crossing ways give a step, one way behind the other a slope, ways that part
/// a slope that ends. Bodies are swept in steps of 0.25 m; what lies between is
/// taken for the worse.
class meeting_curve {
public:
  static constexpr double step_m = 0.25;
  static constexpr double no_matter = -std::numeric_limits<double>::infinity();

  /// Nowhere do they touch.
  meeting_curve() = default;

  /// @param first, second  Stretches of paths on which the middles of bodies
  ///                       are; not empty.
  meeting_curve(const path_stretch& first, const moving_body& first_body,
                const path_stretch& second, const moving_body& second_body);

  /// @returns how far along its path the middle of the first body must have
  /// come before that of the second one may be at `second_m`, m; `no_matter`
  /// if it may be there at any time. Beyond the second's stretch as at its
  /// ends.
  double cleared_m(double second_m) const;

  /// @returns whether they touch anywhere.
  bool is_empty() const { return cleared_m_.empty(); }

  /// @returns the first place of the second body at which it matters where the
  /// first one is; not if empty.
  double begins_m() const { return from_m_; }

  /// @returns the last place at which the first body has to have come farther
  /// than before; not if empty.
  double ends_m() const { return to_m_; }

private:
  double from_m_ = 0, to_m_ = 0;
  std::vector<double> cleared_m_; // every step from `from_m_` on, to `to_m_`
};

} // namespace sofof::world
