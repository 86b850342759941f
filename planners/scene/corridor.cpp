// The corridor, disc by disc.
#include "planners/scene/corridor.hpp"

#include "planners/scene/track.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::planners {
namespace {

/// A part of the car: a disc, or the axle's centre.
struct part {
  double ahead_m, radius_m;
};

// Three discs cover 5.10 m × 1.89 m from 1.0825 m behind the rear axle on,
// to within 4 mm at the corners.
constexpr double disc_radius_m = 1.27;
constexpr std::array<part, lane_bounds::parts> parts_of_car{
    {{0, 0},
     {-0.23, disc_radius_m},
     {1.47, disc_radius_m},
     {3.17, disc_radius_m}}};

/// Knots are the same when they are so near, in steps.
constexpr double same_knot = 1e-6;
/// The car on the line itself fits by this, whatever the discs say.
constexpr double least_room_m = 0.12;
/// At least this is kept.
constexpr double gap_at_last_m = 0.05;
constexpr double touching_m = 0.02;
/// So far discs may leave the lane while the car inside them does not, at
/// headings of up to 0.24 rad.
constexpr double spare_m = 0.15;
/// Parts farther ahead than this are turned more than they are carried.
constexpr double least_lever_m = 0.5;
/// Discs are wider than the car by this at their middle.
constexpr double disc_excess_m = disc_radius_m - 0.945;
/// Way before and after a body on which the car may leave the centre line.
constexpr double evasion_m = 20;
/// Way over which the car comes back into the corridor.
constexpr double return_m = 25;
/// How fast a car that has to come back turns its curvature, 1/m per m: less
/// than paths may (path_planner).
constexpr double steering_1pm2 = 0.05;

/// @returns how far a heading and a curvature to the left carry a part of the
/// car beyond, until it is parallel again, m: the curvature falls evenly, and
/// comes back; what is before the axle turns in long before.
double drift_m(double ahead_m, double heading_rad, double curvature_1pm) {
  const auto out = std::max(0.0, curvature_1pm);
  const auto until_straight_m = out / steering_1pm2;
  const auto heading = std::max(0.0, heading_rad + out * until_straight_m / 2);
  const auto of_axle_m =
      until_straight_m * (std::max(0.0, heading_rad) + heading) / 2
      + heading * std::sqrt(heading / steering_1pm2);
  assert(std::isfinite(of_axle_m) && of_axle_m >= 0);
  if (ahead_m < least_lever_m)
    return of_axle_m;
  const auto slope = std::max(0.0, heading_rad + ahead_m * curvature_1pm);
  return std::min(of_axle_m, slope * slope / (2 * ahead_m * steering_1pm2));
}

} // namespace

double corridor::swing_m(double bends_1pm) {
  constexpr auto front_m = 4.0175; // from the axle to the bumper
  constexpr auto last_disc_m = parts_of_car.back().ahead_m;
  assert(bends_1pm >= 0);
  return std::min(disc_excess_m,
                  bends_1pm * (front_m * front_m - last_disc_m * last_disc_m)
                      / 2);
}

void lane_bounds::move(const reference_line& line, double s_m, double ds_m,
                       int steps) {
  assert(ds_m > 0 && std::isfinite(ds_m));
  assert(steps >= 1 && steps <= ocp::most_steps);
  const auto moved = (s_m - s_m_) / ds_m;
  const auto same_grid = line_ == &line && ds_m == ds_m_ && steps == steps_
                         && std::abs(moved - std::round(moved)) < same_knot;
  const auto by = same_grid && moved >= 0 && moved <= steps
                      ? static_cast<int>(std::lround(moved))
                      : steps + 1;
  assert(by >= 0); // what was measured moves towards the car only
  line_ = &line;
  s_m_ = s_m;
  ds_m_ = ds_m;
  steps_ = steps;
  for (std::size_t part = 0; part < parts; ++part) {
    for (auto* column : {&lo_[part], &hi_[part]}) {
      column->resize(static_cast<std::size_t>(steps) + 1);
      if (by <= steps)
        std::copy(column->begin() + by, column->end(), column->begin());
    }
    measure(part, std::max(0, steps + 1 - by), steps);
    assert(lo_[part].size() == hi_[part].size());
  }
}

void lane_bounds::measure(std::size_t part, int from, int to) {
  assert(line_ && part < parts);
  assert(from >= 0 && to <= steps_);
  const auto [ahead_m, radius_m] = parts_of_car[part];
  for (auto k = from; k <= to; ++k) {
    const auto s = s_m_ + k * ds_m_;
    const auto room = part == 0 ? corridor::freedom_m
                                : line_->half_width_m(s + ahead_m) - radius_m;
    const auto bow = part == 0 ? 0 : line_->bow_m(s, ahead_m);
    const auto at = static_cast<std::size_t>(k);
    lo_[part][at] = std::min(bow - room, -least_room_m);
    hi_[part][at] = std::max(bow + room, least_room_m);
    assert(!(lo_[part][at] > hi_[part][at])); // the line itself fits
  }
}

void corridor::open(const lane_bounds& lane) {
  lane_ = &lane;
  assert(lane.steps() >= 1 && lane.steps() <= ocp::most_steps);
  kept_gap_m_ = passing_gap_m;
  const auto knots = static_cast<std::size_t>(lane.steps()) + 1;
  for (std::size_t j = 0; j < rows; ++j) {
    std::ranges::copy(lane.lo_m(j), lo_[j].begin());
    std::ranges::copy(lane.hi_m(j), hi_[j].begin());
    constexpr auto far_m = std::numeric_limits<double>::infinity();
    std::fill_n(near_left_[j].begin(), knots, far_m);
    std::fill_n(near_right_[j].begin(), knots, -far_m);
    assert(!(lo_[j][0] > hi_[j][0]));
    discs_[j] = {parts_of_car[j].ahead_m, std::span{lo_[j]}.first(knots),
                 std::span{hi_[j]}.first(knots)};
  }
}

void corridor::pass(const lane_obstacle& body, side_of_road side) {
  assert(lane_); // opened
  assert(!(body.from_m > body.to_m));
  // What is lacking is taken from the gap first, then from what discs are
  // wider than the car at the other side.
  const auto from_gap = std::min(body.lacks_m, passing_gap_m - gap_at_last_m);
  const auto over = body.lacks_m - from_gap;
  kept_gap_m_ = std::min(kept_gap_m_, passing_gap_m - from_gap);
  const auto left = side == side_of_road::left ? body.left_m : 0.0;
  for (int k = 0; k <= lane_->steps(); ++k) {
    const auto s = lane_->s_m() + k * lane_->ds_m();
    if (s > body.from_m - evasion_m && s < body.to_m + evasion_m) {
      const auto lane = lane_->line().half_width_m(s);
      lo_[0][k] = std::min(lo_[0][k], -lane);
      hi_[0][k] = std::max(hi_[0][k], lane + left);
      for (std::size_t j = 1; j < rows && left > 0; ++j)
        hi_[j][k] = std::max(hi_[j][k], lane_->hi_m(j, k) + left);
    }
    assert(!(lo_[0][k] > hi_[0][k])); // the discs are held, not the axle
    for (std::size_t j = 1; j < rows; ++j) {
      const auto& p = parts_of_car[j];
      const auto at = s + p.ahead_m;
      const auto reach = p.radius_m + lane_->ds_m() / 2;
      if (at < body.from_m - reach || at > body.to_m + reach)
        continue;
      const auto bow = lane_->line().bow_m(s, p.ahead_m);
      const auto gap = passing_gap_m - from_gap + p.radius_m - disc_excess_m;
      // Who moves may be in its own lane by then.
      constexpr auto far_m = 1e3;
      const auto stands = std::abs(body.speed_mps) < stands_below_mps;
      const auto near =
          stands ? touching_m + p.radius_m - disc_excess_m : -far_m;
      if (side == side_of_road::left) {
        near_right_[j][k] =
            std::max(near_right_[j][k], body.high_m + near + bow);
        lo_[j][k] = std::max(lo_[j][k], body.high_m + gap + bow);
        if (hi_[j][k] >= lane_->hi_m(j, k)) // no other body is there
          hi_[j][k] = std::max(hi_[j][k], lane_->hi_m(j, k) + over);
      } else {
        near_left_[j][k] = std::min(near_left_[j][k], body.low_m - near + bow);
        hi_[j][k] = std::min(hi_[j][k], body.low_m - gap + bow);
        if (lo_[j][k] <= lane_->lo_m(j, k))
          lo_[j][k] = std::min(lo_[j][k], lane_->lo_m(j, k) - over);
      }
    }
  }
}

void corridor::admit(const path_state& start, steering steers) {
  assert(lane_); // opened
  assert(lane_->ds_m() > 0 && kept_gap_m_ >= 0);
  // Both sides alike, measured outwards.
  const auto widened = [](double room, double lane, double over, double off,
                          double fading) {
    return std::max(
        room, std::min(room + over * fading, lane + spare_m + off * fading));
  };
  for (std::size_t j = 0; j < rows; ++j) {
    const auto ahead = parts_of_car[j].ahead_m;
    const auto y = start.d_m + ahead * std::sin(start.heading_rad);
    auto left = y, right = y;
    if (steers == steering::drifts) {
      left += drift_m(ahead, start.heading_rad, start.curvature_1pm);
      right -= drift_m(ahead, -start.heading_rad, -start.curvature_1pm);
    }
    const auto over = std::max(0.0, left - hi_[j][0]);
    const auto under = std::max(0.0, lo_[j][0] - right);
    if (over == 0 && under == 0)
      continue;
    const auto off_left = std::max(0.0, y - lane_->hi_m(j, 0));
    const auto off_right = std::max(0.0, lane_->lo_m(j, 0) - y);
    for (int k = 0; k <= lane_->steps() && k * lane_->ds_m() < return_m; ++k) {
      const auto fading = 1 - k * lane_->ds_m() / return_m;
      // Who is nearer to a body than that stands.
      const auto most = near_left_[j][k], least = near_right_[j][k];
      hi_[j][k] = std::min(
          widened(hi_[j][k], lane_->hi_m(j, k), over, off_left, fading),
          std::max(hi_[j][k], most));
      lo_[j][k] = std::max(
          -widened(-lo_[j][k], -lane_->lo_m(j, k), under, off_right, fading),
          std::min(lo_[j][k], least));
      kept_gap_m_ = std::min({kept_gap_m_, most - hi_[j][k] + touching_m,
                              lo_[j][k] - least + touching_m});
    }
  }
}

bool corridor::contains(std::span<const double> d_m,
                        std::span<const double> heading_rad,
                        double tolerance_m) const {
  assert(d_m.size() == heading_rad.size());
  assert(d_m.size() <= static_cast<std::size_t>(lane_->steps()) + 1);
  assert(tolerance_m >= 0);
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t k = 1; k < d_m.size(); ++k) {
      const auto at = static_cast<int>(k);
      const auto y =
          d_m[k] + parts_of_car[j].ahead_m * std::sin(heading_rad[k]);
      if (y < lo_[j][at] - tolerance_m || y > hi_[j][at] + tolerance_m)
        return false;
    }
  return true;
}

} // namespace sofof::planners
