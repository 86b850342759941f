// When a car is how far, and how fast.
#pragma once

#include "messages/v2x/mcm/p_spline.hpp"

#include <array>
#include <cassert>
#include <cstddef>
#include <span>

namespace sofof::messages {

/// A smooth motion through moments known to a centimetre and a centimetre a
/// second: piecewise of constant jerk, exactly at rest where it rests, never
/// backwards. The closer the moments, the more jerk may change between them.
/// No heap.
class longitudinal_fit {
public:
  struct moment {
    double t_s = 0; ///< The first at 0, rising.
    double way_m = 0;
    double speed_mps = 0; ///< Not negative.
  };
  struct motion {
    double way_m = 0;
    double speed_mps = 0;
    double accel_mps2 = 0;
  };

  static constexpr std::size_t most_steps = p_spline::most_steps;

  /// @param moments  At least 2.
  /// @param before   Motion at the beginning by the plan that it continues;
  ///                 null for nothing.
  /// @param steps    1..most_steps; they end with the moments.
  /// @returns false when there is no such motion.
  bool fit(std::span<const moment> moments, const motion* before,
           std::size_t steps);

  double step_s() const { return step_s_; }
  std::size_t steps() const { return steps_; }

  /// @param knot  0..steps.
  const motion& operator[](std::size_t knot) const {
    assert(knot <= steps_);
    return knots_[knot];
  }

private:
  bool rests_from(std::size_t i) const;
  std::size_t rest(std::size_t i);
  bool drive(std::size_t from, std::size_t to, const motion* before);
  void observe(std::size_t i, double start_s);
  void limit_jerk(std::size_t from, std::size_t to, double start_s,
                  std::size_t steps);
  void roll_out(std::size_t from, std::size_t to);
  void put(motion x);
  double time_of(std::size_t knot) const {
    return static_cast<double>(knot) * step_s_;
  }

  std::span<const moment> moments_;
  p_spline way_;
  double step_s_ = 0;
  std::size_t steps_ = 0;
  std::size_t done_ = 0; // knots
  std::array<motion, most_steps + 1> knots_;
};

} // namespace sofof::messages
