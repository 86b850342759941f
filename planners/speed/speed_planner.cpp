// Setting up the velocity problem, and motions for when it does not fit.
#include "planners/speed/speed_planner.hpp"

#include "planners/problems/thread_solvers.hpp"
#include "planners/speed/clearance.hpp"
#include "planners/speed/closed_form_motion.hpp"
#include "planners/speed/promise.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

constexpr double never = speed_constraints::never;

// Where to stop before a line.
constexpr double wanted_line_gap_m = 0.3;
constexpr double least_way_m = 0.1;

/// Behind a car that crawls, rather stop than follow: it is taken to brake.
constexpr double crawl_ahead_mps = 2.0;
constexpr double crawling_decel_mps2 = 1.0;
/// How long a car ahead is taken to go on as it does.
constexpr double foresight_s = 8.0;
/// A time gap that is too short grows again by this share.
constexpr double opening = 0.1;
constexpr double least_speed_for_gap_mps = 2.0;

/// Up to here, cars move up rather than set off.
constexpr double moving_up_m = 5.0;
constexpr double worth_starting_m = 0.5;
constexpr double halted_mps = 0.05;

constexpr double low_speed_mps = 2.0;
constexpr double share_at_low_speed = 0.65;
/// A plan that began farther back is of another drive.
constexpr double longest_shift_m = 10;
/// Envelopes use this much of jerk and braking; the rest is for plans.
constexpr double envelope_share_of_jerk = 0.8;
constexpr double share_of_braking = 0.95;
constexpr double small = 1e-3;
/// Braking that cannot wait is planned with some reserve.
constexpr double reserve = 1.1;
constexpr double emergency_share_of_jerk = 0.7;
/// A plan that misses its bounds by less (s, m²/s², m/s², m/s³) may be driven
/// all the same if it is clear.
constexpr double reduced_margin = 0.025;
/// A plan's own tolerance is no emergency.
constexpr double beyond_firm_mps2 = 0.05;
/// After an emergency, back to comfort at this jerk.
constexpr double recovery_jerk_mps3 = 5.0;

constexpr double lateral_margin = 0.975;
constexpr double least_curvature_1pm = 1e-4;
constexpr double least_wanted_m2ps2 = 0.125;

/// On speeds that others count on; comfort is in them already.
constexpr double weight_of_promised_speeds = 2;

/// Way to rest when braking builds up at a jerk.
double stopping_m(double v, double a, double decel, double jerk) {
  assert(v >= 0 && decel > 0 && jerk > 0);
  const auto t = (a + decel) / jerk;
  if (t <= 0)
    return v * v / (2 * std::max(decel, -a));
  const auto v1 = v + t * (a - jerk * t / 2);
  const auto x1 = t * (v + t * (a / 2 - jerk * t / 6));
  return v1 > 0 ? x1 + v1 * v1 / (2 * decel) : std::max(x1, 0.0);
}

double square(double x) {
  return x * x;
}

/// The constant braking with which a car is not at a place before some time.
double decel_to_be_late(double v, double way_m, double time_s) {
  if (!(time_s > 0) || v * time_s <= way_m)
    return 0;
  const auto way = std::max(way_m, least_way_m);
  const auto decel = 2 * (v * time_s - way) / square(time_s);
  return v < decel * time_s ? square(v) / (2 * way) : decel; // or at rest
}

} // namespace

speed_planner::speed_planner(route_profile_ptr way, const comfort_limits& style,
                             grid horizon)
    : way_{std::move(way)}, style_{style}, grid_{horizon},
      steps_{static_cast<int>(std::lround(style.horizon_s / style.step_s))} {
  motion_.reserve(static_cast<std::size_t>(steps_) + 1);
  assert(way_ && steps_ >= 1);
  assert(grid_.ds_m > 0 && grid_.steps >= fewest_steps
         && grid_.steps <= ocp::most_steps);
}

speed_planner::stop
speed_planner::find_stop(const speed_constraints& task) const {
  stop end{task.stop_m - wanted_line_gap_m, task.stop_m - least_line_gap_m};
  if (task.ahead) {
    const auto& lead = task.ahead->lead;
    auto left = task.ahead->way_left_m();
    if (lead.speed_mps < crawl_ahead_mps)
      left = std::min(left, square(lead.speed_mps) / (2 * crawling_decel_mps2));
    const auto rear = task.ahead->touch_m + left;
    // Nobody knows more of it than for a while: the plan ends behind it then.
    const auto seen = std::min(rear, task.ahead->at(foresight_s));
    end.wanted_m = std::min(end.wanted_m, seen - style_.standstill_gap_m);
    end.last_m = std::min(end.last_m, rear - least_gap_m);
    assert(!(left < 0 || seen > rear)); // it does not come back
  }
  assert(!(end.wanted_m > end.last_m));
  return end;
}

double speed_planner::needed_decel(const speed_constraints& task) const {
  assert(task.speed_mps >= 0);
  auto needed = 0.0;
  if (std::isfinite(task.stop_m))
    needed = planners::needed_decel(task.speed_mps,
                                    task.stop_m - least_line_gap_m, {});
  if (task.ahead)
    needed = std::max(needed,
                      planners::needed_decel(task.speed_mps,
                                             task.ahead->touch_m - least_gap_m,
                                             task.ahead->lead));
  for (const auto& window : task.windows)
    needed =
        std::max(needed, decel_to_be_late(task.speed_mps, window.at_m,
                                          window.earliest_s - window_slack_s));
  assert(needed >= 0);
  return needed;
}

bool speed_planner::comes_too_late(const speed_constraints& task,
                                   const stop& end) const {
  return task.speed_mps > halted_mps
         && stopping_m(task.speed_mps, task.accel_mps2,
                       style_.firm_decel_mps2(),
                       envelope_share_of_jerk * style_.max_jerk_mps3)
                > end.last_m;
}

/// @returns how far it may move up: to where it stops, or to a place that it
/// may not come to yet.
double speed_planner::free_m(const speed_constraints& task, const stop& end) {
  auto way_m = end.wanted_m;
  for (const auto& window : task.windows)
    if (window.earliest_s > 0)
      way_m = std::min(way_m, std::max(window.at_m, 0.0));
  assert(way_m <= end.wanted_m);
  return way_m;
}

/// @returns whether it has to have passed a place that it does not come to.
bool speed_planner::is_to_be_passed(const speed_constraints& task,
                                    double way_m) {
  return std::ranges::any_of(task.windows, [way_m](const auto& window) {
    return std::isfinite(window.latest_s) && window.at_m > way_m;
  });
}

speed_planner::result speed_planner::plan(const planned_path& path,
                                          double way_m,
                                          const speed_constraints& task,
                                          const ocp::budget& go_on) {
  assert(!path.empty() && std::isfinite(way_m));
  assert(task.speed_mps >= 0 && std::isfinite(task.accel_mps2));
  const auto end = find_stop(task);
  result r;
  if (needed_decel(task) > style_.firm_decel_mps2()
      || comes_too_late(task, end)) {
    r = brake_only(task);
  } else if (const auto up_m = free_m(task, end);
             setting_off::is_needed({0, task.speed_mps, task.accel_mps2},
                                    grid_.ds_m)
             && up_m < moving_up_m) {
    if (is_to_be_passed(task, up_m)) {
      motion_.clear(); // in time, where it would come to rest before that
      return r;
    }
    const auto stands = task.speed_mps < halted_mps && up_m < worth_starting_m;
    r.how = stands ? speed_mode::stands : speed_mode::moves_up;
    r.report.status = ocp::solve_status::converged;
    move_up({0, task.speed_mps, task.accel_mps2}, up_m, style_, steps_,
            motion_);
    solved_ = false;
  } else if (!drive(path, way_m, task, end, r, go_on)) {
    motion_.clear();
    return r;
  }
  r.price = price(path, way_m);
  assert(r.price >= 0 && motion_.front().s_m == 0);
  return r;
}

speed_planner::result speed_planner::brake_only(const speed_constraints& task) {
  const auto decel =
      std::clamp(reserve * needed_decel(task),
                 comfort_limits::least_emergency_mps2, style_.max_decel_mps2);
  assert(decel >= comfort_limits::least_emergency_mps2);
  brake({0, task.speed_mps, task.accel_mps2}, decel,
        emergency_share_of_jerk * style_.emergency_jerk_mps3, style_.step_s,
        steps_, motion_);
  assert(motion_.size() == static_cast<std::size_t>(steps_) + 1);
  solved_ = false;
  result r;
  r.emergency = true;
  r.report.status = ocp::solve_status::soft_infeasible;
  return r;
}

bool speed_planner::drive(const planned_path& path, double way_m,
                          const speed_constraints& task, const stop& end,
                          result& r, const ocp::budget& go_on) {
  const auto start = begin(task);
  const auto& from = start.from;
  const auto ahead = find_stretch(path.length_m() - way_m, from, end);
  if (!ahead)
    return false;
  const auto decel = set_bounds(path, way_m, task, start, *ahead, r.emergency);
  assert(decel > 0);
  const auto recovers =
      from.accel_mps2 < -style_.firm_decel_mps2() - beyond_firm_mps2;
  auto& solver = thread_solvers::here().velocity;
  solve(solver, pose(start, *ahead, decel, recovers),
        path.s_m(way_m + from.s_m), r, go_on);
  if (r.report.iterations == 0 && !solved_)
    return false;
  drive_along(solver, ahead->ds_m, from.s_m, start.at_s, style_.step_s, steps_,
              motion_);
  assert(motion_.size() <= static_cast<std::size_t>(steps_) + 1);
  r.how = speed_mode::optimal;
  r.emergency |= recovers;
  // Where braking is too weak, even a solved plan comes too early.
  return motion_.size() > 1
         && (solved_ ? keeps_windows(motion_, style_.step_s, task)
                     : r.report.violation < reduced_margin
                           && is_clear(motion_, style_.step_s, task));
}

// A car that stands, or nearly so, sets off first.
speed_planner::beginning speed_planner::begin(const speed_constraints& task) {
  assert(task.speed_mps >= 0);
  const lane_motion now{0, task.speed_mps, task.accel_mps2};
  motion_.assign(1, now);
  if (!setting_off::is_needed(now, grid_.ds_m))
    return {now, 0};
  const setting_off ramp{now, envelope_share_of_jerk * style_.max_jerk_mps3};
  ramp.drive(style_.step_s, steps_, motion_);
  assert(ramp.end.s_m >= 0 && ramp.end.speed_mps > 0);
  return {ramp.end, ramp.takes_s};
}

// As far as the path is known, or to where the car has to stop, there in
// comfort if that is before the last place to.
std::optional<speed_planner::stretch>
speed_planner::find_stretch(double path_left_m, const lane_motion& from,
                            const stop& end) const {
  assert(from.s_m >= 0 && from.speed_mps >= 0);
  const auto comfortable_m =
      from.s_m
      + stopping_m(from.speed_mps, from.accel_mps2, style_.comfort_decel_mps2,
                   envelope_share_of_jerk * style_.max_jerk_mps3);
  const auto stop_m = std::clamp(comfortable_m, end.wanted_m,
                                 std::max(end.wanted_m, end.last_m))
                      - from.s_m;
  const auto sight_m = path_left_m - from.s_m;
  const auto full_m = std::min(sight_m, grid_.ds_m * grid_.steps);
  const auto stops = stop_m < full_m;
  const auto length_m = stops ? stop_m : full_m;
  if (!(length_m > 0))
    return std::nullopt;
  const auto steps =
      std::clamp(static_cast<int>(std::ceil(length_m / grid_.ds_m)),
                 fewest_steps, grid_.steps);
  assert(length_m <= grid_.ds_m * steps + small);
  return stretch{stop_m, length_m, length_m / steps, steps, stops};
}

// All bounds, knot by knot, for braking in comfort, or firmly where comfort
// does not do.
// @returns the braking that they allow, m/s².
double speed_planner::set_bounds(const planned_path& path, double way_m,
                                 const speed_constraints& task,
                                 const beginning& start, const stretch& ahead,
                                 bool& emergency) {
  const auto comfort = style_.comfort_decel_mps2;
  const auto firm = style_.firm_decel_mps2();
  const auto& from = start.from;
  assert(comfort > 0 && firm >= comfort);
  assert(!(ahead.stop_m < ahead.length_m)); // or it would stop before the end
  const auto set = [&] {
    set_limits(path, way_m + from.s_m, ahead.ds_m, ahead.steps);
    be_cautious(task, from.s_m, ahead.ds_m);
    w_max_.back() =
        std::min(w_max_.back(), comfort * (ahead.stop_m - ahead.length_m));
    set_windows(task, from, ahead.ds_m);
  };
  set();
  if (yield_to_braking(from, start.at_s, ahead.ds_m,
                       share_of_braking * comfort))
    return comfort;
  set();
  yield_to_braking(from, start.at_s, ahead.ds_m, share_of_braking * firm);
  emergency = too_fast_for_bends();
  return firm;
}

velocity_problem speed_planner::pose(const beginning& start,
                                     const stretch& ahead, double decel_mps2,
                                     bool recovers) const {
  assert(w_max_.size() == static_cast<std::size_t>(ahead.steps) + 1);
  assert(earliest_.size() == w_max_.size() && latest_.size() == w_max_.size());
  const auto& from = start.from;
  velocity_problem p;
  p.steps = ahead.steps;
  p.ds_m = ahead.ds_m;
  p.start = {start.at_s, square(from.speed_mps) / 2, from.accel_mps2};
  p.w_max_m2ps2 = w_max_;
  p.wanted_m2ps2 = wanted_;
  p.curvature_1pm = bends_;
  p.earliest_s = earliest_;
  p.latest_s = latest_;
  if (std::ranges::any_of(promised_, [](double x) { return x < never; }))
    p.weights.speed = weight_of_promised_speeds;
  if (ahead.stops)
    p.stop_knot = ahead.steps;
  p.limits.accel_min_mps2 = std::min(-decel_mps2, from.accel_mps2);
  p.limits.accel_max_mps2 = std::max(style_.max_accel_mps2, from.accel_mps2);
  // From low speeds jerk grows between knots, with speed.
  const auto slow = from.speed_mps < low_speed_mps;
  p.limits.jerk_max_mps3 =
      recovers ? recovery_jerk_mps3
               : (slow ? share_at_low_speed : 1) * style_.max_jerk_mps3;
  p.limits.total_max_mps2 =
      std::hypot(style_.max_lateral_accel_mps2, style_.firm_decel_mps2());
  return p;
}

// From the plan before, if that leads on to `s_m` and helps; or from scratch.
void speed_planner::solve(velocity_ocp& solver, const velocity_problem& p,
                          double s_m, result& r, const ocp::budget& go_on) {
  assert(std::isfinite(s_m));
  const auto stops = p.stop_knot.has_value();
  const auto warm = solved_ && solved_stop_ == stops && s_m >= solved_s_m_
                    && s_m < solved_s_m_ + longest_shift_m;
  solver.resume(kept_);
  if (warm)
    solver.carry_over(s_m - solved_s_m_, p.ds_m, p.steps);
  r.report =
      solver.solve(p, warm ? ocp::start::warm : ocp::start::cold, {}, go_on);
  if (warm && !ocp::publishable(r.report.status))
    r.report = solver.solve(p, ocp::start::cold, {}, go_on);
  solved_ = ocp::publishable(r.report.status);
  assert(!solved_ || solver.steps() == p.steps);
  solver.keep(kept_);
  solved_stop_ = stops;
  solved_s_m_ = s_m;
}

void speed_planner::set_limits(const planned_path& path, double from_m,
                               double ds_m, int steps) {
  assert(ds_m > 0 && steps >= fewest_steps && steps <= grid_.steps);
  const auto knots = static_cast<std::size_t>(steps) + 1;
  for (auto* column : {&w_max_, &wanted_, &bends_})
    column->resize(knots);
  const auto lateral = lateral_margin * style_.max_lateral_accel_mps2;
  auto s = 0.0;
  for (std::size_t k = 0; k < knots; ++k) {
    s = path.s_m(from_m + static_cast<double>(k) * ds_m);
    bends_[k] = path.curvature_1pm(s);
    const auto bend = std::max(path.sharpest_1pm(s), least_curvature_1pm);
    w_max_[k] = std::min(square(way_->line.limit_mps(s)), lateral / bend) / 2;
    assert(w_max_[k] >= 0 && std::isfinite(bends_[k]));
  }
  // What comes behind the horizon must not find the car too fast.
  w_max_.back() =
      std::min(w_max_.back(), square(way_->envelope.limit_mps(s)) / 2);
}

void speed_planner::be_cautious(const speed_constraints& task, double from_m,
                                double ds_m) {
  assert(!(task.caution_mps < 0));
  const auto w = square(task.caution_mps) / 2;
  for (std::size_t k = 0; k < w_max_.size(); ++k)
    if (from_m + static_cast<double>(k) * ds_m <= task.caution_to_m)
      w_max_[k] = std::min(w_max_[k], w);
}

void speed_planner::set_windows(const speed_constraints& task,
                                const lane_motion& from, double ds_m) {
  assert(ds_m > 0 && from.s_m >= 0);
  const auto knots = w_max_.size();
  earliest_.assign(knots, -never);
  latest_.assign(knots, never);
  for (const auto& window : task.windows) {
    // The knot before the place opens late, the knot behind it closes early.
    const auto steps = std::clamp((window.at_m - from.s_m) / ds_m, 0.0,
                                  static_cast<double>(knots));
    const auto before = static_cast<std::size_t>(steps);
    const auto behind = static_cast<std::size_t>(std::ceil(steps));
    assert(before <= behind && behind <= knots);
    for (auto k = before; k < knots; ++k)
      earliest_[k] = std::max(earliest_[k], window.earliest_s);
    if (behind < knots)
      latest_[behind] = std::min(latest_[behind], window.latest_s);
  }
  promised_.resize(knots);
  bound_by_promise(task, from.s_m, ds_m, earliest_, latest_, promised_);
  if (!task.ahead)
    return;
  const auto& ahead = *task.ahead;
  const auto gap_m = style_.standstill_gap_m;
  // A gap that is too short now opens slowly.
  const auto now_s = (ahead.touch_m - gap_m)
                     / std::max(task.speed_mps, least_speed_for_gap_mps);
  for (std::size_t k = 0; k < knots; ++k) {
    const auto t =
        ahead.when_s(from.s_m + static_cast<double>(k) * ds_m + gap_m);
    if (t == never)
      return; // behind where it comes to rest, and so does the plan
    const auto opened = now_s + opening * std::max(0.0, t);
    earliest_[k] =
        std::max(earliest_[k], t + std::min(style_.time_gap_s, opened));
  }
}

// Even firm braking comes too late for them.
bool speed_planner::too_fast_for_bends() const {
  assert(w_max_.size() == bends_.size());
  constexpr auto tolerance = 1.02;
  for (std::size_t k = 0; k < w_max_.size(); ++k)
    if (2 * w_max_[k] * std::abs(bends_[k])
        > tolerance * style_.max_lateral_accel_mps2)
      return true;
  return false;
}

// No bound may ask for more than braking can do.
bool speed_planner::yield_to_braking(const lane_motion& from, double from_s,
                                     double ds_m, double decel_mps2) {
  assert(ds_m > 0 && decel_mps2 > 0);
  assert(earliest_.size() == w_max_.size() && wanted_.size() == w_max_.size());
  const auto slow = from.speed_mps < low_speed_mps;
  const auto jerk = (slow ? share_at_low_speed : envelope_share_of_jerk)
                    * style_.max_jerk_mps3;
  auto w = square(from.speed_mps) / 2, a = from.accel_mps2, t = from_s;
  auto fits = true;
  for (std::size_t k = 0; k < w_max_.size(); ++k) {
    fits = fits && w <= w_max_[k] + small && earliest_[k] <= t + small;
    w_max_[k] = std::max(w_max_[k], w);
    earliest_[k] = std::min(earliest_[k], t);
    wanted_[k] = std::max(w_max_[k], least_wanted_m2ps2);
    const auto v = std::sqrt(2 * w);
    const auto next_a =
        std::max(a - jerk * ds_m / std::max(v, setting_off::until_mps),
                 std::min(a, -decel_mps2));
    const auto next_w = w + ds_m * (a + next_a) / 2;
    assert(w >= 0 && next_a <= a); // at least as firmly as before
    a = next_a;
    t += 2 * ds_m / (ocp::speed_of(w) + ocp::speed_of(next_w)); // as there
    w = std::max(0.0, next_w);
  }
  // Waiting costs little over way: without this, cars crawl until what holds
  // them up is far off, rather than drive as fast as it lets them.
  auto mean = never;
  for (auto k = wanted_.size() - 1; k > 0; --k) {
    if (earliest_[k] > from_s)
      mean = std::min(mean,
                      static_cast<double>(k) * ds_m / (earliest_[k] - from_s));
    wanted_[k] =
        std::max(std::min(wanted_[k], square(mean) / 2), least_wanted_m2ps2);
  }
  for (std::size_t k = 0; k < wanted_.size(); ++k)
    if (promised_[k] < never)
      wanted_[k] = std::clamp(promised_[k], least_wanted_m2ps2,
                              std::max(w_max_[k], least_wanted_m2ps2));
  return fits;
}

// As the velocity problem prices its plans, but over time, so that plans of
// different length can be compared.
double speed_planner::price(const planned_path& path, double way_m) const {
  assert(style_.step_s > 0 && !path.empty());
  assert(!motion_.empty());
  constexpr velocity_weights weigh;
  auto sum = 0.0;
  for (std::size_t i = 1; i < motion_.size(); ++i) {
    const auto &x = motion_[i], &before = motion_[i - 1];
    const auto limit = way_->line.limit_mps(path.s_m(way_m + x.s_m));
    const auto jerk = (x.accel_mps2 - before.accel_mps2) / style_.step_s;
    sum += weigh.speed * square(limit - x.speed_mps)
           + weigh.accel * square(x.accel_mps2) + weigh.jerk * square(jerk);
  }
  return sum * style_.step_s;
}

} // namespace sofof::planners
