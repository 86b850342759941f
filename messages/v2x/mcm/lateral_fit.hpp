// The way of a car beside its route's centre line.
#pragma once

#include "messages/v2x/mcm/p_spline.hpp"
#include "world/roads/path.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace sofof::messages {

/// A smooth line along a path through points known to a centimetre. Where the
/// path is straight it is taken to keep to the path; where the path bends it
/// may cut the corner, and its own curvature changes evenly rather than with
/// the path's. No heap.
class lateral_fit {
public:
  struct sight {
    world::path_offset at;
    double slope = 0; ///< d' over s; unknown where its weight is 0.
    double slope_weight = 0;
  };
  /// What is known of the beginning: a place on the plan that it continues.
  struct joint {
    point at;
    double heading_rad = 0;
    double curvature_1pm = 0;
  };

  /// @param line    Kept by reference.
  /// @param sights  At least one; s does not fall.
  /// @param before  Null for nothing.
  /// @returns false when there is no such line.
  bool fit(const world::path& line, std::span<const sight> sights,
           const joint* before);

  /// Way along the course, from its beginning to abreast of `s_m` on the
  /// path; and back.
  double way_m(double s_m) const;
  double s_m(double way_m) const;

  /// Position, tangent and curvature of the course abreast of `s_m`.
  world::path_point at(double s_m) const;

private:
  static constexpr std::size_t most_knots = p_spline::most_steps + 1;
  static constexpr std::size_t most_reach = 12;
  using column = std::array<double, most_knots>;
  using reachable = std::array<double, most_knots + 2 * most_reach>;

  void add(std::span<const sight> sights);
  reachable sharpest_about() const;
  void expect_little(double freedom);
  void expect(const joint& before);
  bool meets(std::span<const sight> sights) const;
  void measure();

  const world::path* line_ = nullptr;
  p_spline offset_;
  double start_m_ = 0, step_m_ = 1;
  std::size_t steps_ = 1;
  column bend_;    // of the path, 1/m
  column stretch_; // way per arc length of the path
  column way_;     // m
};

} // namespace sofof::messages
