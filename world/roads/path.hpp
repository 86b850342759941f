// A smooth line through given points, addressed by arc length.
#pragma once

#include "base/geometry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace sofof::world {

/// Where a path is and how it bends at one arc length.
struct path_point {
  point at;                 ///< m, east-north.
  double heading_rad = 0;   ///< Tangent, counter-clockwise from east.
  double curvature_1pm = 0; ///< Positive to the left.
};

/// The same, with its tangent as a vector of unit length (to within 1e-5).
struct path_frame : path_point {
  point tangent;
};

/// A point seen from a path: arc length and signed offset.
struct path_offset {
  double s_m = 0;
  double d_m = 0;      ///< Positive to the left.
  double beyond_m = 0; ///< Along the tangent: beyond an end, or before it; 0
                       ///< (to within 1 mm) for who is abreast of it.
};

/// A cubic spline over chord length (C2, so with continuous curvature)
/// through the given points, tabulated by arc length; immutable. Open paths
/// end straight (natural ends), closed ones are periodic.
class path {
public:
  path() = default;

  /// @param points  At least 2 (open) or 3 (closed), no two neighbours equal,
  ///                m. A closed path returns from the last to the first.
  /// @throws std::invalid_argument otherwise.
  explicit path(std::span<const point> points, bool closed = false);

  double length_m() const { return length_m_; }
  bool closed() const { return closed_; }

  /// Whether it bends nowhere, or is too short for its table to tell.
  bool is_straight() const { return table_.size() == 2; }

  /// Arc lengths of the given points, in order, m.
  std::span<const double> knots_m() const { return knots_m_; }

  /// The spline to within 0.1 mm. The heading is continuous in s, not
  /// wrapped: it starts in (-pi, pi], and every lap of a closed path adds the
  /// path's whole turn (a multiple of 2 pi). Precondition: not empty.
  /// @param s_m  Any finite value: closed paths wrap, open ones clamp.
  path_point at(double s_m) const;

  /// The same, with what `at` must not pay for.
  path_frame frame(double s_m) const;

  /// Of `at`, the curvature alone.
  double curvature_1pm(double s_m) const;

  /// Nearest point within `window_m` of arc length around a guess; cheap when
  /// the guess is good. Precondition: not empty.
  /// @param s_guess_m  Any finite value; on a closed path laps count.
  /// @returns an arc length of the guess's lap (or of the next one, over the
  /// seam); beyond the window or an open end, the offset from the tangent
  /// there.
  path_offset project(point p, double s_guess_m, double window_m = 20) const;

  /// Nearest point of the whole path; at most O(length).
  path_offset project(point p) const;

private:
  struct knot {
    point at;
    point tangent; // of unit length
    double heading_rad;
    double curvature_1pm;
  };
  struct place {
    const knot& low;
    const knot& high;
    double share; // of the step from low to high, in [0, 1]
    double laps;  // whole laps before it
  };
  struct hermite;
  struct view { // a point as seen from a place on the path
    double along_m, left_m, curvature_1pm;
  };
  place locate(double s_m) const;
  path_point at(const place& x) const;
  view look(point p, double s_m) const;
  static double next_to(const view& seen, double s_m);
  bool is_nearest_about(const view& seen, double window_m) const;
  double nearest_entry(point p, double start_m, double low_m,
                       double high_m) const;
  path_offset refine(point p, double s_m, double low_m, double high_m) const;

  // Equidistant in arc length, both ends included; these alone if it is
  // straight.
  std::vector<knot> table_;
  std::vector<double> knots_m_;
  double step_m_ = 0;
  double steps_per_m_ = 0;
  double length_m_ = 0;
  double turn_rad_ = 0; // heading gained over the whole path
  double sharpest_1pm_ = 0;
  bool closed_ = false;
};

// Inline, for planners ask at every point of a plan.

/// Cubic interpolation between two table entries from values and their
/// derivatives over arc length: of the position that is the unit tangent, of
/// the heading the curvature.
struct path::hermite {
  double t, step_m;

  template <class T>
  T operator()(T low, T low_slope, T high, T high_slope) const {
    const auto rest = 1 - t, rise = t * t * (3 - 2 * t);
    return (1 - rise) * low + rise * high
           + (t * rest * step_m) * (rest * low_slope - t * high_slope);
  }

  template <class T>
  T slope(T low, T low_slope, T high, T high_slope) const {
    const auto rest = 1 - t;
    return (6 * t * rest / step_m) * (high - low)
           + rest * (1 - 3 * t) * low_slope + t * (3 * t - 2) * high_slope;
  }
};

inline path::place path::locate(double s_m) const {
  assert(!table_.empty());
  auto laps = 0.0;
  if (closed_ && !(0 <= s_m && s_m < length_m_))
    laps = std::floor(s_m / length_m_);
  const auto steps =
      std::clamp(s_m - laps * length_m_, 0.0, length_m_) * steps_per_m_;
  // Signed numbers are converted in one instruction.
  const auto last = static_cast<std::ptrdiff_t>(table_.size()) - 2;
  const auto i = std::min(static_cast<std::ptrdiff_t>(steps), last);
  const auto* low = table_.data() + i;
  return {low[0], low[1], std::min(steps - static_cast<double>(i), 1.0), laps};
}

inline path_point path::at(const place& x) const {
  const auto& [low, high, t, laps] = x;
  const hermite mix{t, step_m_};
  return {mix(low.at, low.tangent, high.at, high.tangent),
          mix(low.heading_rad, low.curvature_1pm, high.heading_rad,
              high.curvature_1pm)
              + laps * turn_rad_,
          (1 - t) * low.curvature_1pm + t * high.curvature_1pm};
}

inline path_point path::at(double s_m) const {
  return at(locate(s_m));
}

inline path_frame path::frame(double s_m) const {
  const auto x = locate(s_m);
  const auto& [low, high, t, laps] = x;
  const hermite mix{t, step_m_};
  return {at(x), mix.slope(low.at, low.tangent, high.at, high.tangent)};
}

inline double path::curvature_1pm(double s_m) const {
  const auto [low, high, t, laps] = locate(s_m);
  return (1 - t) * low.curvature_1pm + t * high.curvature_1pm;
}

inline path::view path::look(point p, double s_m) const {
  const auto [low, high, t, laps] = locate(s_m);
  const hermite mix{t, step_m_};
  const auto tangent = mix.slope(low.at, low.tangent, high.at, high.tangent);
  const auto to = p - mix(low.at, low.tangent, high.at, high.tangent);
  return {dot(tangent, to), cross(tangent, to),
          (1 - t) * low.curvature_1pm + t * high.curvature_1pm};
}

} // namespace sofof::world
