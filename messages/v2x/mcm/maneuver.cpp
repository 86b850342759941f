// From what an MCM says to a plan.
#include "messages/v2x/mcm/maneuver.hpp"

#include "messages/etsi/units.hpp"
#include "messages/v2x/mcm/lateral_fit.hpp"
#include "messages/v2x/mcm/longitudinal_fit.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>

namespace sofof::messages {
namespace {

constexpr std::int32_t largest_cm = 131071;
constexpr std::int32_t largest_ms = 65535;
constexpr std::int32_t largest_cmps = 16382;
constexpr std::int32_t largest_step_ms = 255;
constexpr double usual_step_s = 0.1;
constexpr double first_window_m = 20;
constexpr double window_m = 1.5; // the speeds tell where to look
constexpr double farthest_m = 5; // beside the route, as planners go
constexpr double shortest_slope_inner = 0.2;

// A plan that differs by more than rounding is another plan.
constexpr double same_place_m = 0.03;
constexpr double same_speed_mps = 0.03;

// Headings are rounded to 0.1°.
constexpr double heading_sigma_rad = 0.0005;
constexpr double no_heading = 1e9;

/// What both kinds of points say, on the map.
struct sample {
  double t_s = 0;
  point at;
  double speed_mps = 0;
  double heading_rad = no_heading;
};
using samples = std::array<sample, most_waypoints>;

bool is_in_range(std::int32_t x_cm, std::int32_t y_cm,
                 std::int32_t speed_cmps) {
  return x_cm >= -largest_cm && x_cm <= largest_cm && y_cm >= -largest_cm
         && y_cm <= largest_cm && speed_cmps >= 0 && speed_cmps <= largest_cmps;
}

/// Turns what is given to geographic east and north.
struct map_axes {
  explicit map_axes(const maneuver_frame& f)
      : origin{f.reference}, east{f.earth.to_map_axes({0.01, 0}, f.reference)},
        north{f.earth.to_map_axes({0, 0.01}, f.reference)} {}

  point operator()(std::int32_t x_cm, std::int32_t y_cm) const {
    return origin + static_cast<double>(x_cm) * east
           + static_cast<double>(y_cm) * north;
  }

  point origin, east, north;
};

/// @returns the point of `before` where a new plan begins, if it continues it.
const world::trajectory_point* find_joint(const world::trajectory* before,
                                          time_point start, const sample& first,
                                          world::trajectory_point& at) {
  if (before == nullptr || before->points.size() < 2 || start < before->start
      || start >= before->end())
    return nullptr;
  at = before->at(start);
  const auto same =
      distance_m(at.at, first.at) < same_place_m
      && std::abs(at.speed_mps - first.speed_mps) < same_speed_mps;
  return same ? &at : nullptr;
}

/// @returns whether a car's tyres could do that.
bool can_be_driven(const world::trajectory& plan) {
  constexpr double most_accel_mps2 = 12;
  return std::ranges::all_of(plan.points, [](const world::trajectory_point& p) {
    return std::abs(p.accel_mps2) <= most_accel_mps2
           && p.speed_mps * p.speed_mps * std::abs(p.curvature_1pm)
                  <= most_accel_mps2;
  });
}

class reader {
public:
  reader(std::span<const sample> seen, const world::route& way)
      : seen_{seen}, way_{way} {}

  maneuver_fault read(double s_guess_m, const world::trajectory* before,
                      world::trajectory& out) {
    if (!project(s_guess_m))
      return maneuver_fault::off_route;
    world::trajectory_point at;
    const auto* joint = find_joint(before, out.start, seen_[0], at);
    if (!fit(joint))
      return maneuver_fault::no_motion;
    write(out);
    return out.is_sound() && can_be_driven(out) ? maneuver_fault::none
                                                : maneuver_fault::no_motion;
  }

private:
  bool project(double guess_m) {
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const auto& x = seen_[i];
      if (i > 0) {
        const auto& last = seen_[i - 1];
        guess_m = sights_[i - 1].at.s_m
                  + (x.t_s - last.t_s) * (x.speed_mps + last.speed_mps) / 2;
      }
      auto& sight = sights_[i];
      sight.at =
          way_.path().project(x.at, guess_m, i > 0 ? window_m : first_window_m);
      const point away{sight.at.beyond_m, sight.at.d_m};
      if (!(dot(away, away) <= farthest_m * farthest_m))
        return false;
      // Forwards: rounding can set a car back that hardly moves.
      if (i > 0)
        sight.at.s_m = std::max(sight.at.s_m, sights_[i - 1].at.s_m);
      if (x.heading_rad < no_heading)
        see_slope(sight, x.heading_rad);
    }
    return true;
  }

  void see_slope(lateral_fit::sight& sight, double heading_rad) {
    const auto centre = way_.path().at(sight.at.s_m);
    const auto turned = wrap_angle(heading_rad - centre.heading_rad);
    constexpr double steepest_rad = 1;
    if (std::abs(turned) > steepest_rad)
      return;
    const auto inner =
        std::max(shortest_slope_inner, 1 - centre.curvature_1pm * sight.at.d_m);
    sight.slope = std::tan(turned) * inner;
    sight.slope_weight = 1 / (heading_sigma_rad * heading_sigma_rad);
  }

  bool fit(const world::trajectory_point* before) {
    const auto n = seen_.size();
    lateral_fit::joint joint;
    longitudinal_fit::motion motion;
    if (before != nullptr) {
      joint = {before->at, before->heading_rad, before->curvature_1pm};
      motion = {0, before->speed_mps, before->accel_mps2};
    }
    if (!lateral_.fit(way_.path(), {sights_.data(), n},
                      before != nullptr ? &joint : nullptr))
      return false;
    std::array<longitudinal_fit::moment, most_waypoints> moments;
    for (std::size_t i = 0; i < n; ++i)
      moments[i] = {seen_[i].t_s, lateral_.way_m(sights_[i].at.s_m),
                    seen_[i].speed_mps};
    const auto steps =
        std::clamp(std::round(seen_.back().t_s / usual_step_s), 1.0,
                   static_cast<double>(longitudinal_fit::most_steps));
    return longitudinal_.fit({moments.data(), n},
                             before != nullptr ? &motion : nullptr,
                             static_cast<std::size_t>(steps));
  }

  void write(world::trajectory& out) const {
    out.points.resize(longitudinal_.steps() + 1);
    for (std::size_t k = 0; k <= longitudinal_.steps(); ++k) {
      const auto& x = longitudinal_[k];
      const auto s_m = lateral_.s_m(x.way_m);
      const auto place = lateral_.at(s_m);
      out.points[k] = {static_cast<double>(k) * longitudinal_.step_s(),
                       s_m,
                       place.at,
                       place.heading_rad,
                       place.curvature_1pm,
                       x.speed_mps,
                       x.accel_mps2};
    }
  }

  std::span<const sample> seen_;
  const world::route& way_;
  std::array<lateral_fit::sight, most_waypoints> sights_;
  lateral_fit lateral_;
  longitudinal_fit longitudinal_;
};

} // namespace

maneuver_place place_maneuver(const geo_frame& earth, point at, time_point t) {
  const auto reference = earth.to_wgs84(at);
  return {reference,
          {earth, earth.to_map(reference).value_or(at),
           std::chrono::floor<std::chrono::milliseconds>(t)}};
}

std::string_view to_string(maneuver_fault fault) {
  switch (fault) {
    case maneuver_fault::none:
      return "nothing is wrong";
    case maneuver_fault::wrong_count:
      return "not 2 to 128 points";
    case maneuver_fault::times_not_rising:
      return "times do not rise";
    case maneuver_fault::out_of_range:
      return "a number is out of range";
    case maneuver_fault::off_route:
      return "a point is off the route";
    case maneuver_fault::not_understood:
      return "it says more or less than when to be where";
    case maneuver_fault::no_motion:
      return "no car can do that";
  }
  return "unknown";
}

maneuver_fault to_trajectory(std::span<const maneuver_waypoint> waypoints,
                             const maneuver_frame& frame,
                             const world::route& way, double s_guess_m,
                             const world::trajectory* before,
                             world::trajectory& out) {
  assert(before != &out);
  const auto n = waypoints.size();
  if (n < 2 || n > most_waypoints)
    return maneuver_fault::wrong_count;
  const map_axes on_map{frame};
  samples seen;
  const auto first_ms = waypoints[0].t_ms;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& x = waypoints[i];
    if (!is_in_range(x.x_cm, x.y_cm, x.speed_cmps) || x.t_ms < 0
        || x.t_ms > largest_ms)
      return maneuver_fault::out_of_range;
    if (i > 0 && x.t_ms <= waypoints[i - 1].t_ms)
      return maneuver_fault::times_not_rising;
    seen[i] = {1e-3 * (x.t_ms - first_ms), on_map(x.x_cm, x.y_cm),
               0.01 * x.speed_cmps};
  }
  out.start = frame.generated + std::chrono::milliseconds{first_ms};
  return reader{{seen.data(), n}, way}.read(s_guess_m, before, out);
}

maneuver_fault to_trajectory(const planned_points& planned,
                             const maneuver_frame& frame,
                             const world::route& way, double s_guess_m,
                             const world::trajectory* before,
                             world::trajectory& out) {
  assert(before != &out);
  const auto n = planned.points.size();
  if (n < 2 || n > most_waypoints)
    return maneuver_fault::wrong_count;
  if (planned.step_ms < 1)
    return maneuver_fault::times_not_rising;
  if (planned.step_ms > largest_step_ms || planned.start_ms < 0
      || planned.start_ms > largest_ms)
    return maneuver_fault::out_of_range;
  const map_axes on_map{frame};
  samples seen;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& x = planned.points[i];
    const auto heading = frame.earth.to_map_heading(x.heading, frame.reference);
    if (!is_in_range(x.x_cm, x.y_cm, x.speed_cmps) || x.heading < 0
        || x.heading > etsi::unavailable_angle)
      return maneuver_fault::out_of_range;
    seen[i] = {1e-3 * planned.step_ms * static_cast<double>(i),
               on_map(x.x_cm, x.y_cm), 0.01 * x.speed_cmps,
               heading.value_or(no_heading)};
  }
  out.start = frame.generated + std::chrono::milliseconds{planned.start_ms};
  return reader{{seen.data(), n}, way}.read(s_guess_m, before, out);
}

} // namespace sofof::messages
