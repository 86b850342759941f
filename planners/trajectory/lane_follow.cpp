// Lane following as a roll-out: at every step the strictest of four wishes
// (speed, route, line, car ahead) decides, as fast as jerk allows.
#include "planners/trajectory/lane_follow.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace sofof::planners {
namespace {

// Where to stop before a line, and what must be kept in any case.
constexpr double line_gap_m = 0.3;
constexpr double min_line_gap_m = 0.15;
constexpr double min_lead_gap_m = 1.0;

// A car ahead that is slower than this is more and more a place to stop at.
constexpr double crawling_mps = 1.0;
// Standing cars start only when it is worth it.
constexpr double standing_mps = 0.05;
constexpr double worth_starting_mps2 = 0.3;

constexpr double rounding = 1e-6;
// How much more jerk for how much more braking.
constexpr double jerk_per_braking_1ps = 5.0;
// On the way to a place, less jerk than allowed: the rest is for corrections.
constexpr double share_of_jerk = 0.8;

braking_style style_of(const comfort_limits& params) {
  return {params.comfort_decel_mps2, share_of_jerk * params.max_jerk_mps3,
          params.time_gap_s};
}

} // namespace

/// What the car has to mind at one moment of the plan.
struct lane_follow::traffic_ahead {
  double stop_at_m = std::numeric_limits<double>::infinity(); // front bumper
  bool led = false;
  double lead_rear_m = 0;
  leader lead;

  /// Moves the car ahead on by `dt_s`.
  void advance(double dt_s) {
    if (!led)
      return;
    const auto x = planners::advance(
        {lead_rear_m, lead.speed_mps, lead.accel_mps2}, lead.accel_mps2, dt_s);
    lead_rear_m = x.s_m;
    lead = {x.speed_mps, x.accel_mps2};
  }
};

lane_follow::lane_follow(route_profile_ptr way, comfort_limits params)
    : way_{std::move(way)}, params_{params}, style_{style_of(params)} {
  assert(way_ && params_.step_s > 0);
}

lane_follow::lane_follow(world::route_ptr way, const comfort_limits& params)
    : lane_follow{std::make_shared<const route_profile>(std::move(way), params),
                  params} {}

plan_report lane_follow::plan(time_point now, const planning_input& input,
                              const world::trajectory* previous,
                              world::trajectory& out, const ocp::budget&) {
  assert(previous != &out);
  const auto& way = way_->line.way();
  const centring line{way, joined(way, now, input, previous),
                      params_.centring_length_m};
  traffic_ahead others;
  if (!way.closed())
    others.stop_at_m = way.length_m();
  if (input.others.stop_at_m)
    others.stop_at_m = std::min(others.stop_at_m, *input.others.stop_at_m);
  if (input.others.lead) {
    const auto lead = moved_forward(*input.others.lead, input.others.at, now);
    others.led = true;
    others.lead_rear_m = lead.rear_s_m;
    others.lead = {lead.speed_mps, lead.accel_mps2};
  }

  const auto steps = std::lround(params_.horizon_s / params_.step_s);
  assert(steps >= 1);
  out.start = now;
  out.points.resize(static_cast<std::size_t>(steps) + 1);
  plan_report report;
  report.input = input.at;
  auto x = line.motion();
  for (long i = 0;; ++i) {
    out.points[i] = line.place(x, static_cast<double>(i) * params_.step_s);
    report.emergency |= x.accel_mps2 < -params_.firm_decel_mps2() - rounding;
    if (i == steps)
      break;
    others.advance(params_.step_s);
    assert(!(x.speed_mps < 0));
    x = advance(x, next_accel(x, others), params_.step_s);
  }
  tell_extremes(out, params_, report);
  return report;
}

/// The acceleration that the driver would like at `x`.
double lane_follow::wanted_accel(const lane_motion& x,
                                 const traffic_ahead& others) const {
  const auto v = x.speed_mps;
  const auto front_m = x.s_m + params_.front_m;
  const auto firm = params_.firm_decel_mps2();
  const auto limit = way_->envelope.at(x.s_m);
  assert(limit.speed_mps > 0 && firm > 0);

  auto wanted = std::min(params_.max_accel_mps2,
                         limit.accel_mps2 * v / limit.speed_mps
                             + style_.rate_1ps() * (limit.speed_mps - v));
  auto needed = 0.0;
  auto floor = -firm;
  if (std::isfinite(others.stop_at_m)) {
    const auto room_m = others.stop_at_m - front_m;
    wanted = std::min(wanted, stop_accel(v, room_m - line_gap_m, style_));
    needed = needed_decel(v, room_m - min_line_gap_m, {});
  }
  if (others.led) {
    const auto& lead = others.lead;
    const auto gap_m = others.lead_rear_m - front_m;
    const auto room_m = gap_m - params_.standstill_gap_m;
    const auto moving = std::min(lead.speed_mps / crawling_mps, 1.0);
    auto accel = moving * follow_accel(v, room_m, lead, style_);
    if (moving < 1)
      accel += (1 - moving) * stop_accel(v, room_m, style_);
    wanted = std::min(wanted, accel);
    needed = std::max(needed, needed_decel(v, gap_m - min_lead_gap_m, lead));
    floor = std::min(floor, lead.accel_mps2);
  }
  assert(needed >= 0);
  wanted = std::max(wanted, floor);
  return needed > firm ? std::min(wanted, -needed) : wanted;
}

/// Comfortable up to firm braking, from there up to what an emergency needs.
double lane_follow::jerk_limit(double accel_mps2) const {
  const auto beyond = -accel_mps2 - params_.firm_decel_mps2();
  if (beyond <= 0)
    return params_.max_jerk_mps3;
  return std::min(params_.emergency_jerk_mps3,
                  params_.max_jerk_mps3 + jerk_per_braking_1ps * beyond);
}

double lane_follow::next_accel(const lane_motion& x,
                               const traffic_ahead& others) const {
  const auto dt = params_.step_s;
  const auto ahead = advance(x, x.accel_mps2, dt);
  auto wanted = std::max(wanted_accel(ahead, others), -params_.max_decel_mps2);
  if (x.speed_mps < standing_mps && x.accel_mps2 <= 0
      && wanted < worth_starting_mps2)
    wanted = std::min(wanted, -worth_starting_mps2);
  assert(wanted >= -params_.max_decel_mps2);
  const auto change = dt * jerk_limit(std::min(wanted, x.accel_mps2));
  assert(change > 0);
  return std::clamp(wanted, x.accel_mps2 - change, x.accel_mps2 + change);
}

} // namespace sofof::planners
