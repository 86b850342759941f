// Problems to practise on: a slalom for the path, traffic for the velocity.
// Repeatable, without files; for tests, benchmarks, and as examples.
#pragma once

#include "planners/problems/path_ocp.hpp"
#include "planners/problems/velocity_ocp.hpp"

#include <array>
#include <vector>

namespace sofof::planners {

/// A winding road with obstacles in turn on the left and on the right, seen
/// from a car of 3 discs.
class slalom {
public:
  static constexpr int discs = 3;

  /// @param steps     Horizon N.
  /// @param ds_m      Its step.
  /// @param width_m   Between the corridor's sides; obstacles take 55 % of it.
  explicit slalom(int steps = 80, double ds_m = 1, double width_m = 5);

  /// @returns the problem when the car is that many knots down the road; it
  /// lives until the next call.
  const path_problem& at(int knot, const path_state& start);

private:
  double curvature_1pm(double s_m) const;

  double width_m_;
  std::vector<double> curvature_, wanted_;
  std::array<std::vector<double>, discs> lo_, hi_;
  std::array<disc_corridor, discs> corridor_;
  path_problem problem_;
};

/// A road with bends, and what happens on it.
class practice_road {
public:
  enum class event {
    free_flow,
    slow_leader, ///< 6 m/s, 40 m ahead when the drive begins.
    stop_line,   ///< 70 m ahead when the drive begins.
    crossing,    ///< Not before 12 s, 60 m ahead when the drive begins.
  };

  /// @param steps  Horizon N.
  explicit practice_road(event what, int steps = 160, double ds_m = 0.5);

  /// @returns the problem when the car is that many knots down the road; it
  /// lives until the next call.
  /// @param now_s  Since the drive began. Times in start count from now.
  const velocity_problem& at(int knot, double now_s,
                             const velocity_state& start);

private:
  event what_;
  std::vector<double> w_max_, wanted_, curvature_, earliest_, latest_;
  velocity_problem problem_;
};

} // namespace sofof::planners
