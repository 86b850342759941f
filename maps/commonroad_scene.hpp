// What a CommonRoad scenario says beside its lanes: who moves on them, and
// what is to be driven.
#pragma once

#include "base/geometry.hpp"

#include "maps/xml_file.hpp"
#include <optional>
#include <string>
#include <vector>

namespace sofof::maps {

/// Times of a scenario are whole steps of equal length.
using time_step = int;

/// Numbers from `low` to `high`.
struct closed_interval {
  double low = 0, high = 0;

  bool holds(double x) const { return low <= x && x <= high; }

  /// @returns whether an angle, rad, is one of these, full turns aside.
  bool holds_angle(double angle_rad) const;
};

/// A part of the plane, with its rim: a polygon, or a disc if it has no
/// corners.
struct scene_region {
  std::vector<point> corners;
  point centre;
  double radius_m = 0;

  bool contains(point p) const;
};

/// One of the states that a drive may end in.
struct goal_state {
  std::vector<scene_region> places; ///< In one of them; none: anywhere.
  time_step first = 0, last = 0;    ///< When.
  std::optional<closed_interval> speed_mps, heading_rad;
};

/// Where a drive begins, and where it may end.
struct planning_problem {
  std::string id;
  time_step begin = 0;
  point at; ///< The middle of the vehicle.
  double heading_rad = 0, speed_mps = 0;
  std::vector<goal_state> goals; ///< At least one.

  /// @returns the last step at which it may end.
  time_step end() const;
};

/// A rectangle on the road, step by step; one that stands has one step and is
/// always there.
struct scene_body {
  struct state {
    time_step step = 0;
    point at; ///< Of its middle.
    double heading_rad = 0, speed_mps = 0;
  };

  std::string id;
  bool moves = false;
  double length_m = 0, width_m = 0; ///< Around what the file draws.
  std::vector<state> states;        ///< In rising order; at least one.
};

struct commonroad_scene {
  std::string benchmark; ///< "ZAM_Tjunction-1_42_T-1".
  std::string version;   ///< "2020a".
  double step_s = 0.1;
  std::vector<scene_body> bodies;
  std::vector<std::vector<point>> houses;   ///< Each a simple polygon.
  std::vector<std::vector<point>> lanelets; ///< Their outlines.
  std::vector<planning_problem> problems;
  std::vector<std::string> left_out; ///< Sentences.
};

/// Reads versions 2018b and 2020a: obstacles that stand or move on
/// trajectories or by occupancies, houses, planning problems. All is in the
/// file's own frame.
/// @param file  Its root is <commonRoad>.
/// @throws input_error with the place of what is wrong.
commonroad_scene read_commonroad_scene(const xml_file& file);

} // namespace sofof::maps
