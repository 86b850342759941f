// Where the car may be beside its reference line: the lane, less what stands
// in it.
#pragma once

#include "planners/problems/path_ocp.hpp"
#include "planners/scene/driving_scene.hpp"
#include "planners/scene/reference_line.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sofof::planners {

/// On which side of a body to pass.
enum class side_of_road : unsigned char { left, right };

/// Where the rear axle and three discs that cover the car may be in a lane
/// with nothing in it, knot by knot. A disc is held by the lane where it is,
/// not where the axle is. The line itself always fits.
class lane_bounds {
public:
  /// Of the rear axle and the discs.
  static constexpr std::size_t parts = ocp::path_rows::most_discs;

  /// Goes to the knots s_m + k · ds_m, k = 0..steps; most of them are those of
  /// the cycle before.
  /// @param line  Must outlive this.
  void move(const reference_line& line, double s_m, double ds_m, int steps);

  const reference_line& line() const { return *line_; }
  double s_m() const { return s_m_; }
  double ds_m() const { return ds_m_; }
  int steps() const { return steps_; }

  /// Least and greatest offset of a part's middle, at each knot or at one.
  std::span<const double> lo_m(std::size_t part) const { return lo_[part]; }
  std::span<const double> hi_m(std::size_t part) const { return hi_[part]; }
  double lo_m(std::size_t part, int k) const {
    return lo_[part][static_cast<std::size_t>(k)];
  }
  double hi_m(std::size_t part, int k) const {
    return hi_[part][static_cast<std::size_t>(k)];
  }

private:
  void measure(std::size_t part, int from, int to);

  const reference_line* line_ = nullptr;
  double s_m_ = 0, ds_m_ = 1;
  int steps_ = -1;
  std::array<std::vector<double>, parts> lo_, hi_;
};

/// Bounds on the same parts in a lane with bodies in it.
class corridor {
public:
  /// How far the rear axle may leave the centre line where nothing stands in
  /// the lane, m: half of what crossing and passing traffic leaves between
  /// two bodies (world/roads/conflict.hpp).
  static constexpr double freedom_m = 0.25;

  /// A car needs so much room beside a body: the discs, and a gap.
  static constexpr double room_beside_m = 2.42;

  /// Of that, the gap.
  static constexpr double passing_gap_m = 0.2;

  /// @param bends_1pm  Curvature of the line away from a body, >= 0.
  /// @returns how much farther than its sides the car's front corner comes to
  /// a body on the outer side of a bend, m: that is to be added to the body.
  static double swing_m(double bends_1pm);

  /// The lane with nothing in it.
  /// @param lane  Kept, until the next one.
  void open(const lane_bounds& lane);

  /// Narrows it beside a body; the car may use the whole lane there.
  void pass(const lane_obstacle& body, side_of_road side);

  enum class steering {
    as_planned, ///< It is where its path leads back into the corridor.
    drifts      ///< Its heading and curvature carry it on at first.
  };

  /// Widens it near the car as far as it needs to come back into it, beside
  /// bodies by what is left of the gap at most.
  void admit(const path_state& start, steering steers);

  std::span<const disc_corridor> discs() const { return discs_; }

  /// @returns the least gap that it keeps beside a body, m.
  double gap_m() const { return kept_gap_m_; }

  /// @returns whether a car that keeps to the line of knots
  /// d(k), θ(k) stays within, up to `tolerance_m`.
  bool contains(std::span<const double> d_m,
                std::span<const double> heading_rad, double tolerance_m) const;

private:
  static constexpr std::size_t rows = lane_bounds::parts;

  const lane_bounds* lane_ = nullptr;
  double kept_gap_m_ = passing_gap_m;
  std::array<ocp::column, rows> lo_, hi_;
  std::array<ocp::column, rows> near_right_, near_left_; // bodies, to a touch
  std::array<disc_corridor, rows> discs_;
};

} // namespace sofof::planners
