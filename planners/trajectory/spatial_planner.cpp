// Path, speeds, choice, and what is published.
#include "planners/trajectory/spatial_planner.hpp"

#include "planners/scene/lane_motion.hpp"
#include "planners/scene/track.hpp"
#include "planners/speed/clearance.hpp"
#include "planners/trajectory/safe_stop.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace sofof::planners {
namespace {

/// A new way past the others must be cheaper by this share.
constexpr double hysteresis = 0.15;
/// A plan before is kept no longer than this, and while this is left of it.
constexpr double longest_kept_s = 1.0;
constexpr double least_left_s = 1.5;
constexpr double rounding_mps2 = 1e-6;
/// A car ahead that slows down less than this keeps its speed.
constexpr double least_braking_mps2 = 0.3;
/// Who is slower than this among crossings may as well stand there.
constexpr double rests_below_mps = 0.5;
/// What a car keeps to the one ahead behind a crossing.
constexpr double least_way_out_m = 1.0;
/// A path that could not be planned on keeps so far off bodies at least; it
/// ends here, before its end.
constexpr double closest_m = 0.1;
constexpr double path_end_gap_m = 2.0;

/// Path and speeds are planned on grids alike.
template <class Planner>
constexpr typename Planner::grid grid_of(const spatial_params& p) {
  return {p.step_m, static_cast<int>(p.horizon_m / p.step_m)};
}

bool is_moving(const lane_obstacle& body) {
  return std::abs(body.speed_mps) > stands_below_mps;
}

/// Of plans to cross, the best first. Cars that each come to rest among
/// crossings for another one stand there for ever.
enum class worth { drives, waits, rests, brakes, none };

} // namespace

spatial_planner::spatial_planner(route_profile_ptr way,
                                 const comfort_limits& style,
                                 const spatial_params& params)
    : way_{std::move(way)}, style_{style}, params_{params},
      path_{std::make_unique<path_planner>(way_->line,
                                           grid_of<path_planner>(params))},
      speed_{std::make_unique<speed_planner>(way_, style,
                                             grid_of<speed_planner>(params))} {
  assert(params_.candidates >= 1 && params_.alternations >= 1);
  assert(params_.step_m > 0
         && params_.horizon_m / params_.step_m <= ocp::most_steps);
}

plan_report spatial_planner::plan(time_point now, const planning_input& input,
                                  const world::trajectory* previous,
                                  world::trajectory& out,
                                  const ocp::budget& go_on) {
  assert(previous != &out);
  assert(!previous || !previous->empty());
  if (previous && made_ && previous->start > *made_)
    forget();
  made_ = now;
  plan_report report;
  report.input = input.at;
  const scene at{now, joined(lane(), now, input, previous), input.others,
                 to_seconds(now - input.others.at), previous};
  s_m_ = at.start.s_m;
  assert(std::isfinite(s_m_) && at.start.speed_mps >= 0);
  auto done = false;
  for (auto round = 0; round < params_.alternations; ++round) {
    auto better = report;
    if (!plan_path(at, better, go_on) || !plan_speed(at, better, go_on))
      break; // what was found before stays good
    publish(now, out);
    report = better;
    done = true;
    if (std::ranges::none_of(bodies_, &is_moving))
      break;
  }
  if (done) {
    kept_from_.reset();
  } else if (previous && keep(*previous, at, out)) {
    report.origin = plan_origin::kept;
    report.emergency = std::ranges::any_of(out.points, [this](const auto& p) {
      return p.accel_mps2 < -style_.firm_decel_mps2() - rounding_mps2;
    });
  } else {
    kept_from_.reset();
    report.origin = plan_origin::stop;
    report.emergency = true;
    if (path_->path().empty()) {
      out = safe_stop(lane(), now, at.start);
    } else {
      speed_->brake_only(task(at));
      publish(now, out);
    }
  }
  if (!out.is_sound()) { // for what was no number
    report.origin = plan_origin::stop;
    report.emergency = true;
    out = safe_stop(lane(), now, at.start);
  }
  assert(out.start == now && out.is_sound());
  tell_extremes(out, style_, report);
  return report;
}

// What was planned here belongs to a plan that nobody drives any more.
void spatial_planner::forget() {
  path_->forget();
  speed_->forget();
  sides_ = 0;
  crossed_ = {};
  kept_from_.reset();
}

// -- path ---------------------------------------------------------------------

bool spatial_planner::plan_path(const scene& at, plan_report& report,
                                const ocp::budget& go_on) {
  const path_start car{
      at.start.s_m,
      {at.start.d_m, at.start.heading_error_rad, at.start.curvature_1pm}};
  list_bodies(at);
  list_sides(bodies_, lane_m(car.s_m), sides_, most(), all_sides_);
  assert(path_ != other_path_ && all_sides_.size() <= most());
  auto cheapest = std::numeric_limits<double>::infinity();
  for (const auto& sides : all_sides_) {
    // All begin with the knot that the car is coming to, as in the path that
    // was chosen last; that one is planned first.
    const auto first = &sides == &all_sides_.front();
    auto& trial = first ? path_ : other_path_;
    if (!first && !trial)
      trial = std::make_unique<path_planner>(*path_);
    else if (!first)
      *trial = *path_;
    const auto solved = trial->plan(car, sides.bodies, go_on);
    report.iterations += solved.iterations;
    const auto cost = trial->settled() ? solved.cost : cheapest;
    if (!first && cost >= cheapest)
      continue;
    cheapest = first && sides.choice == sides_ ? (1 - hysteresis) * cost : cost;
    report.path = solved.status;
    report.violation = solved.violation;
    sides_ = sides.choice;
    if (!first)
      std::swap(path_, other_path_);
  }
  if (path_->path().empty())
    return false;
  way_m_ = std::max(0.0, path_->path().way_m(car.s_m)); // but for rounding
  assert(way_m_ >= 0 && way_m_ <= path_->path().length_m());
  if (!path_->settled()) // it knows nothing of what is new
    for (const auto& body : bodies_)
      blocked_s_m_ = std::min(blocked_s_m_, meets_m(body));
  return true;
}

// Those ahead that the car can pass, up to the first that it cannot.
void spatial_planner::list_bodies(const scene& at) {
  const auto front_s = at.start.s_m + style_.front_m;
  bodies_.clear();
  blocked_s_m_ = speed_constraints::never;
  for (const auto& body : at.others.beside) {
    const auto where = met(body, at.age_s);
    if (where.from_m > where.to_m)
      continue; // never beside it
    const auto half_m = lane_m(where.from_m);
    const auto passable = leaves_room(where, side_of_road::left, half_m)
                          || leaves_room(where, side_of_road::right, half_m);
    if (passable && bodies_.size() < most_bodies) {
      bodies_.push_back(where);
    } else if (where.from_m > front_s) {
      blocked_s_m_ = where.from_m;
      break;
    }
  }
  assert(bodies_.size() <= most_bodies);
  assert(blocked_s_m_ > front_s);
}

double spatial_planner::lane_m(double s_m) const {
  return way_->line.half_width_m(bodies_.empty() ? s_m
                                                 : bodies_.front().from_m);
}

// Where the front is when the car would touch a body, beside which it may be
// already; never: infinity.
double spatial_planner::meets_m(const lane_obstacle& body) const {
  constexpr auto step_m = 0.5;
  assert(!path_->path().empty());
  assert(!(body.from_m > body.to_m));
  const auto may_stop = body.from_m > s_m_ + style_.front_m;
  const auto half_m = car_.width_m / 2 + (may_stop ? closest_m : 0.0);
  for (auto s = std::max(s_m_, body.from_m - style_.front_m);
       s < body.to_m + car_.rear_m; s += step_m) {
    const auto d = path_->path().at_s(s).x.d_m;
    if (d - half_m < body.high_m && d + half_m > body.low_m)
      return s + style_.front_m;
  }
  return speed_constraints::never;
}

// A body that moves narrows the lane where the car will be beside it.
lane_obstacle spatial_planner::met(const lane_obstacle& body,
                                   double age_s) const {
  if (!is_moving(body) || path_->path().empty() || speed_->motion().empty())
    return body;
  assert(std::isfinite(way_m_));
  auto where = body;
  where.from_m = speed_constraints::never;
  where.to_m = -speed_constraints::never;
  const auto& motion = speed_->motion();
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const auto t = static_cast<double>(i) * style_.step_s;
    const auto moved = body.speed_mps * (age_s + t);
    const auto s = path_->path().s_m(way_m_ + motion[i].s_m);
    const auto from = std::max(s - car_.rear_m, body.from_m + moved);
    const auto to = std::min(s + car_.front_m, body.to_m + moved);
    if (from <= to) {
      where.from_m = std::min(where.from_m, from);
      where.to_m = std::max(where.to_m, to);
    }
  }
  // Beside it once, or never.
  assert(where.from_m <= where.to_m
         || where.from_m == speed_constraints::never);
  return where;
}

// -- speed --------------------------------------------------------------------

double spatial_planner::way_from_car(double s_m) const {
  return path_->path().empty() ? s_m - s_m_ : path_->path().way_m(s_m) - way_m_;
}

speed_constraints spatial_planner::task(const scene& at) {
  assert(at.start.speed_mps >= 0 && std::isfinite(at.start.accel_mps2));
  const auto way = [this](double s) { return way_from_car(s); };
  speed_constraints t;
  t.speed_mps = at.start.speed_mps;
  t.accel_mps2 = at.start.accel_mps2;
  auto stop_s = blocked_s_m_;
  if (!lane().closed())
    stop_s = std::min(stop_s, lane().length_m());
  if (at.others.stop_at_m)
    stop_s = std::min(stop_s, *at.others.stop_at_m);
  if (std::isfinite(stop_s))
    t.stop_m = way_from_car(stop_s - style_.front_m);
  if (!path_->settled() && !path_->path().empty())
    t.stop_m =
        std::min(t.stop_m, path_->path().length_m() - way_m_ - path_end_gap_m);
  if (params_.cautious_sight_m > 0) {
    t.caution_mps =
        std::sqrt(2 * style_.firm_decel_mps2() * params_.cautious_sight_m);
    for (const auto from_m : at.others.yields_m)
      if (t.caution_to_m <= 0) // the next that its front has not reached
        t.caution_to_m = way_from_car(from_m - style_.front_m);
  }
  if (at.others.lead) {
    const auto lead = moved_forward(*at.others.lead, at.others.at, at.now);
    const auto brakes = lead.accel_mps2 < -least_braking_mps2;
    t.ahead = {way_from_car(lead.rear_s_m - style_.front_m),
               {lead.speed_mps, brakes ? lead.accel_mps2 : 0}};
  }
  assert(!t.ahead || t.ahead->lead.accel_mps2 <= 0);
  if (at.others.agreed)
    agreed_.keep_to(*at.others.agreed, at.age_s, way, t);
  return t;
}

crossing_car spatial_planner::crossing(const scene& at) const {
  constexpr auto look_m = 5.0;
  assert(at.start.speed_mps >= 0 && params_.horizon_m > look_m);
  const auto& line = way_->line;
  auto top_mps = 0.0; // where it is, a corner may slow it down
  for (auto ahead_m = 0.0; ahead_m < params_.horizon_m; ahead_m += look_m)
    top_mps = std::max(top_mps, line.limit_mps(at.start.s_m + ahead_m));
  return {style_.front_m,        car_.rear_m,
          at.start.speed_mps,    top_mps,
          style_.max_accel_mps2, style_.firm_decel_mps2(),
          at.start.accel_mps2,   at.others.is_impatient};
}

// Before a place where others cross, rather than on it, where the way out is
// not free, as long as the car can stop there.
double spatial_planner::kept_free_m(const speed_constraints& t,
                                    const scene& at) const {
  const auto car = crossing(at);
  const auto stopping = stopping_m(car);
  assert(stopping >= 0 && !std::isnan(t.stop_m));
  assert(std::ranges::is_sorted(at.others.keep_free, {}, &way_stretch::from_m));
  for (const auto& stretch : at.others.keep_free) {
    const auto line_m = way_from_car(stretch.from_m - style_.front_m);
    const auto clear_m = way_from_car(stretch.to_m + car_.rear_m);
    if (line_m < stopping)
      continue;
    const auto stops_on_it = t.stop_m > line_m && t.stop_m < clear_m;
    const auto stops_behind_it =
        t.ahead && t.ahead->touch_m > line_m
        && t.ahead->at(soonest_s(clear_m, car)) < clear_m + least_way_out_m;
    if (stops_on_it || stops_behind_it)
      return std::min(t.stop_m, line_m);
  }
  return t.stop_m;
}

// Whoever comes to rest there holds up those who are held up already: a car
// waits before all crossings instead, but not for ever.
bool spatial_planner::rests_among(const speed_profile& motion,
                                  const scene& at) const {
  assert(!motion.empty() && motion.front().s_m == 0);
  if (at.others.is_impatient)
    return false;
  const auto stopping = stopping_m(crossing(at));
  assert(stopping >= 0 && std::isfinite(stopping));
  return std::ranges::any_of(at.others.keep_free, [&](const way_stretch& x) {
    const auto line_m = way_from_car(x.from_m - style_.front_m);
    const auto clear_m = way_from_car(x.to_m + car_.rear_m);
    return line_m >= stopping
           && std::ranges::any_of(motion, [&](const auto& moment) {
                return moment.s_m > line_m && moment.s_m < clear_m
                       && moment.speed_mps < rests_below_mps;
              });
  });
}

void spatial_planner::list_users(const scene& at) {
  users_.clear();
  for (auto user : at.others.crossings) {
    user.enter_s -= at.age_s;
    user.leave_s -= at.age_s;
    if (user.leave_s > 0)
      users_.push_back(user);
  }
}

bool spatial_planner::plan_speed(const scene& at, plan_report& report,
                                 const ocp::budget& go_on) {
  assert(!path_->path().empty() && !all_sides_.empty());
  list_users(at);
  const auto car = crossing(at);
  const auto way = [this](double s) { return way_from_car(s); };
  const auto when_s = [&](double way_m) {
    if (at.in_use)
      for (const auto& p : at.in_use->points)
        if (way(p.s_m) >= way_m)
          return p.t_s - to_seconds(at.now - at.in_use->start);
    return speed_constraints::never;
  };
  const auto is_as_before = list_orders(
      users_, car, way, going_on(crossed_, users_, car, way, when_s), most(),
      all_orders_);
  const auto free = task(at);
  assert(!all_orders_.empty() && speed_ != other_speed_);
  constexpr auto nothing_yet =
      std::pair{worth::none, std::numeric_limits<double>::infinity()};
  auto best = nothing_yet;
  report.candidates =
      static_cast<std::int32_t>(all_sides_.size() * all_orders_.size());
  for (const auto& order : all_orders_) {
    const auto first = &order == &all_orders_.front();
    const auto waits = order.choice == crossing_order::waits;
    if (waits && best.first == worth::drives)
      continue; // only when nothing else is left
    auto& trial = first ? speed_ : other_speed_;
    if (!first && !trial)
      trial = std::make_unique<speed_planner>(way_, style_,
                                              grid_of<speed_planner>(params_));
    else if (!first)
      trial->forget();
    auto t = free;
    t.windows = std::span{order.windows}.first(order.count);
    told_.follow(at.others.lead_told, at.age_s, style_.front_m, way, t);
    t.stop_m = std::min(t.stop_m, order.stop_m);
    t.stop_m = kept_free_m(t, at);
    const auto result =
        in_time_or_late(*trial, path_->path(), way_m_, t, go_on);
    report.is_late = report.is_late || t.later_s == speed_constraints::never;
    report.iterations += result.report.iterations;
    if (best == nothing_yet)
      report.velocity = result.report.status;
    if (trial->motion().empty())
      continue;
    const auto price =
        first && is_as_before ? (1 - hysteresis) * result.price : result.price;
    const auto is_worth = result.emergency                   ? worth::brakes
                          : waits                            ? worth::waits
                          : rests_among(trial->motion(), at) ? worth::rests
                                                             : worth::drives;
    assert(!std::isnan(price));
    if (std::pair{is_worth, price} >= best)
      continue;
    best = {is_worth, price};
    crossed_ = choice_of(order);
    report.velocity = result.report.status;
    report.violation = std::max(report.violation, result.report.violation);
    report.emergency = result.emergency;
    report.choice = order.choice << 8 | sides_;
    if (!first)
      std::swap(speed_, other_speed_);
  }
  assert(best == nothing_yet || std::isfinite(best.second));
  return best != nothing_yet;
}

// -- what is published --------------------------------------------------------

bool spatial_planner::keep(const world::trajectory& previous, const scene& at,
                           world::trajectory& out) {
  const auto left_s = to_seconds(previous.end() - at.now);
  if (previous.start > at.now || left_s < least_left_s
      || to_seconds(at.now - kept_from_.value_or(previous.start))
             > longest_kept_s)
    return false;
  const auto steps = static_cast<std::size_t>(left_s / style_.step_s);
  assert(steps >= 1);
  kept_.clear();
  out.start = at.now;
  out.points.resize(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) {
    const auto t_s = static_cast<double>(i) * style_.step_s;
    auto& p = out.points[i] = previous.at(at.now + from_seconds(t_s));
    p.t_s = t_s;
    kept_.push_back({way_from_car(p.s_m), p.speed_mps, p.accel_mps2});
  }
  kept_from_ = kept_from_.value_or(previous.start);
  assert(kept_.size() == out.points.size() && *kept_from_ <= at.now);
  return is_clear(kept_, style_.step_s, task(at)) && avoids_crossings()
         && passes(out, at.others.beside);
}

// Nobody who goes first is met where both cross.
bool spatial_planner::avoids_crossings() const {
  assert(!kept_.empty());
  assert(style_.step_s > 0);
  return std::ranges::none_of(users_, [this](const crossing_user& user) {
    const auto from = way_from_car(user.from_m - style_.front_m);
    const auto to = way_from_car(user.to_m + car_.rear_m);
    for (std::size_t i = 1; i < kept_.size(); ++i) {
      const auto t = static_cast<double>(i) * style_.step_s;
      if (user.goes_first && t > user.enter_s && t < user.leave_s
          && kept_[0].s_m < from && kept_[i].s_m > from && kept_[i].s_m < to)
        return true;
    }
    return false;
  });
}

bool spatial_planner::passes(const world::trajectory& plan,
                             std::span<const lane_obstacle> bodies) const {
  assert(plan.is_sound());
  assert(car_.width_m > 0 && style_.front_m > 0);
  const auto half_m = car_.width_m / 2;
  return std::ranges::none_of(bodies, [&](const lane_obstacle& body) {
    return std::ranges::any_of(
        plan.points, [&](const world::trajectory_point& p) {
          if (p.s_m < body.from_m - style_.front_m
              || p.s_m > body.to_m + car_.rear_m)
            return false;
          const auto d = seen_from(lane(), p).d_m;
          return d - half_m < body.high_m && d + half_m > body.low_m;
        });
  });
}

void spatial_planner::publish(time_point now, world::trajectory& out) const {
  const auto& path = path_->path();
  const auto& motion = speed_->motion();
  assert(!path.empty() && !motion.empty());
  assert(motion.front().s_m == 0); // the car now
  out.start = now;
  out.points.resize(motion.size());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const auto& x = motion[i];
    const auto place = path.at_way(way_m_ + x.s_m);
    const auto centre = lane().path().at(place.s_m);
    const point left{-std::sin(centre.heading_rad),
                     std::cos(centre.heading_rad)};
    out.points[i] = {static_cast<double>(i) * style_.step_s,
                     place.s_m,
                     centre.at + place.x.d_m * left,
                     centre.heading_rad + place.x.heading_rad,
                     place.x.curvature_1pm,
                     x.speed_mps,
                     x.accel_mps2};
  }
}

} // namespace sofof::planners
