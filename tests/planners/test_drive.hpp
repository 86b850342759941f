// A car on a synthetic street in closed loop: a plan every 50 ms, control
// every 10 ms, and what was worst on the way.
#pragma once

#include "planners/trajectory/lane_follow.hpp"
#include "planners/trajectory/spatial_planner.hpp"
#include "world/vehicle/vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace sofof::test {

inline world::route_ptr make_route(std::vector<point> points,
                                   std::vector<world::speed_zone> limits,
                                   bool closed) {
  if (closed)
    points.push_back(points.front());
  std::vector<world::lane> lanes(1);
  lanes[0].name = "street";
  lanes[0].centre = std::move(points);
  lanes[0].limits = std::move(limits);
  return std::make_shared<const world::route>(
      "test", lanes, std::vector<std::size_t>{0}, closed, world::lane_index{});
}

inline void append_line(std::vector<point>& to, point a, point b) {
  const auto pieces = std::max(1.0, std::floor(distance_m(a, b) / 8));
  for (auto i = 0.0; i < pieces; ++i)
    to.push_back(a + (i / pieces) * (b - a));
}

inline void append_arc(std::vector<point>& to, point centre, double radius_m,
                       double from_rad, double by_rad) {
  const auto pieces = std::max(4.0, std::ceil(radius_m * std::abs(by_rad) / 2));
  for (auto i = 0.0; i < pieces; ++i) {
    const auto angle = from_rad + by_rad * i / pieces;
    to.push_back(centre + radius_m * point{std::cos(angle), std::sin(angle)});
  }
}

/// Due east.
inline world::route_ptr straight(double length_m,
                                 std::vector<world::speed_zone> limits) {
  std::vector<point> points;
  append_line(points, {0, 0}, {length_m, 0});
  points.push_back({length_m, 0});
  return make_route(std::move(points), std::move(limits), false);
}

/// Counter-clockwise, 300 m × 120 m: two corners of 10 m, two of 25 m radius.
inline world::route_ptr oval(std::vector<world::speed_zone> limits) {
  constexpr auto quarter = std::numbers::pi / 2;
  constexpr double w = 300, h = 120, tight = 10, wide = 25;
  std::vector<point> p;
  append_line(p, {tight, 0}, {w - tight, 0});
  append_arc(p, {w - tight, tight}, tight, -quarter, quarter);
  append_line(p, {w, tight}, {w, h - wide});
  append_arc(p, {w - wide, h - wide}, wide, 0, quarter);
  append_line(p, {w - wide, h}, {wide, h});
  append_arc(p, {wide, h - wide}, wide, quarter, quarter);
  append_line(p, {0, h - wide}, {0, tight});
  append_arc(p, {tight, tight}, tight, 2 * quarter, quarter);
  return make_route(std::move(p), std::move(limits), true);
}

/// Left, then right, 20 m radius each, between straights.
inline world::route_ptr s_curve(std::vector<world::speed_zone> limits) {
  constexpr auto quarter = std::numbers::pi / 2;
  std::vector<point> p;
  append_line(p, {0, 0}, {150, 0});
  append_arc(p, {150, 20}, 20, -quarter, quarter);
  append_arc(p, {190, 20}, 20, 2 * quarter, -quarter);
  append_line(p, {190, 40}, {350, 40});
  p.push_back({350, 40});
  return make_route(std::move(p), std::move(limits), false);
}

/// What was worst so far.
struct extremes {
  double lateral_m = 0;
  double over_limit = 0; ///< Speed over what is allowed.
  double min_accel_mps2 = 0;
  double jerk_mps3 = 0; ///< Of the car.
  double plan_jerk_mps3 = 0;
  double plan_lateral_mps2 = 0; ///< Lateral acceleration.
  double plan_gap_m = 0;        ///< Where a plan joins the one before.
  double plan_change_m = 0;     ///< One second ahead, against the plan before.
};

using planner_ptr = std::unique_ptr<planners::trajectory_planner>;

inline planner_ptr follower(world::route_ptr way,
                            planners::comfort_limits style = {}) {
  return std::make_unique<planners::lane_follow>(std::move(way), style);
}

inline planner_ptr optimiser(world::route_ptr way,
                             planners::spatial_params params = {},
                             planners::comfort_limits style = {}) {
  return std::make_unique<planners::spatial_planner>(
      std::make_shared<planners::route_profile>(std::move(way), style), style,
      params);
}

class test_drive {
public:
  explicit test_drive(world::route_ptr way, double s_m = 0,
                      double speed_mps = 0,
                      planners::comfort_limits params = {})
      : test_drive{way, s_m, speed_mps, follower(way, params)} {}

  test_drive(world::route_ptr way, double s_m, double speed_mps,
             planner_ptr planner)
      : way_{std::move(way)}, planner_{std::move(planner)}, s_m_{s_m} {
    const auto start = way_->path().at(s_m);
    car.at = start.at;
    car.heading_rad = start.heading_rad;
    car.speed_mps = speed_mps;
    car.steer_rad = std::atan(ability.wheelbase_m * start.curvature_1pm);
    plan.points.push_back({0, s_m, start.at, start.heading_rad,
                           start.curvature_1pm, speed_mps, 0});
  }

  /// One planning cycle: a plan and five steps of control.
  void cycle() {
    auto input = planners::seen_from(*way_, plan.at(now));
    input.at = now;
    input.others = others;
    input.others.at = now;
    known_.push_back(input);
    while (now - known_.front().at > staleness)
      known_.pop_front();

    std::swap(plan, before_);
    report = planner_->plan(now, known_.front(), planned_ ? &before_ : nullptr,
                            plan);
    if (planned_)
      compare_plans();
    planned_ = true;
    judge_plan();
    for (auto i = 0; i < 5; ++i)
      control();
  }

  void drive(double seconds) {
    for (auto t = 0.0; t < seconds - 1e-6; t += 0.05)
      cycle();
  }

  double s_m() const { return s_m_; }
  double front_m() const { return s_m_ + ability.front_m; }
  double rear_m() const { return s_m_ - ability.rear_m; }

  /// As the car behind perceives this one.
  planners::lead_vehicle as_lead() const {
    return {1, rear_m(), car.speed_mps, car.accel_mps2};
  }

  world::vehicle_params ability;
  world::vehicle_state car;
  world::trajectory plan;
  planners::plan_report report;
  time_point now;
  planners::driving_scene others;
  duration staleness{}; ///< Of the planner's input.
  extremes worst;
  int emergencies = 0; ///< Plans that were.

private:
  void judge_plan() {
    for (const auto& p : plan.points)
      worst.plan_lateral_mps2 =
          std::max(worst.plan_lateral_mps2,
                   p.speed_mps * p.speed_mps * std::abs(p.curvature_1pm));
    emergencies += report.emergency ? 1 : 0;
  }

  void compare_plans() {
    const auto change_m = [&](double ahead_s) {
      const auto t = now + from_seconds(ahead_s);
      return distance_m(plan.at(t).at, before_.at(t).at);
    };
    worst.plan_gap_m = std::max(worst.plan_gap_m, change_m(0));
    worst.plan_change_m = std::max(worst.plan_change_m, change_m(1));
    for (std::size_t i = 1; i < plan.points.size(); ++i) {
      const auto &a = plan.points[i - 1], &b = plan.points[i];
      if (b.speed_mps > 0) // coming to rest ends with a step, as brakes do
        worst.plan_jerk_mps3 =
            std::max(worst.plan_jerk_mps3,
                     std::abs(b.accel_mps2 - a.accel_mps2) / (b.t_s - a.t_s));
    }
  }

  void control() {
    constexpr auto dt_s = 0.01;
    const auto accel_mps2 = car.accel_mps2;
    car =
        world::step(car, world::follow(car, plan, now, ability), ability, dt_s);
    now += from_seconds(dt_s);
    const auto place = way_->path().project(car.at, plan.at(now).s_m, 5);
    s_m_ = place.s_m;
    worst.lateral_m = std::max(worst.lateral_m, std::abs(place.d_m));
    worst.over_limit =
        std::max(worst.over_limit, car.speed_mps / way_->limit_mps(s_m_));
    worst.min_accel_mps2 = std::min(worst.min_accel_mps2, car.accel_mps2);
    if (car.speed_mps > 0)
      worst.jerk_mps3 = std::max(worst.jerk_mps3,
                                 std::abs(car.accel_mps2 - accel_mps2) / dt_s);
  }

  world::route_ptr way_;
  planner_ptr planner_;
  double s_m_;
  std::deque<planners::planning_input> known_;
  world::trajectory before_;
  bool planned_ = false;
};

} // namespace sofof::test
