// Whether a plan that another computer has made may be followed.
#include "planners/judges/plan_judge.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::planners {

namespace {

constexpr auto boundless = std::numeric_limits<double>::infinity();

/// @returns the unit vector of a heading; cheap where the heading is the lane's
/// but for half a radian, as it mostly is.
point axis_of(double heading_rad, const world::path_frame& lane) {
  const auto e = heading_rad - lane.heading_rad;
  if (std::abs(e) > 0.5)
    return {std::cos(heading_rad), std::sin(heading_rad)};
  const auto sine = e * (1 - e * e / 6 * (1 - e * e / 20));
  const auto cosine = 1 - e * e / 2 * (1 - e * e / 12);
  const point left{-lane.tangent.y_m, lane.tangent.x_m};
  return cosine * lane.tangent + sine * left;
}

/// @returns how far a line from the one to the other is beyond the road.
double beyond_sides_m(const world::route::bounds& road, double rear_d_m,
                      double front_d_m) {
  return std::max(std::max(rear_d_m, front_d_m) - road.left_m,
                  -std::min(rear_d_m, front_d_m) - road.half_width_m);
}

} // namespace

bool plan_judge::history::add(bool failed) {
  bits = (bits << 1 | static_cast<unsigned>(failed)) & 0b111;
  return failed && std::popcount(bits) >= 2;
}

plan_verdict plan_judge::judge_unreadable() {
  const objection why{"readable", 0, 1};
  if (unusable_.add(true))
    return {false, why};
  return {false, {}, why};
}

plan_verdict plan_judge::judge(const judged_plan& x) {
  assert(!x.plan.empty() && std::isfinite(x.s_m));
  assert(!judged_at_ || *judged_at_ <= x.now);
  const auto passed_s = judged_at_ ? std::min(to_seconds(x.now - *judged_at_),
                                              limits.longest_pause_s)
                                   : 0;
  judged_at_ = x.now;
  if (to_seconds(x.now - x.own.at) > limits.own_age_s)
    return {false, {}};

  bodies_.look(x.way, x.s_m, x.seen.objects, car_);
  const auto found = follow(x);
  // Before the place: a car that cannot brake so hard is soon elsewhere.
  if (const auto fault = brake(x, found.brakes_hard, passed_s))
    return {false, fault};
  const auto begins = look_at_start(x);
  if (begins.age_s < -limits.same_time_s)
    return {false, {}}; // clocks differ
  const auto useless = find_useless(x, begins);
  if (unusable_.add(useless.has_value()))
    return {false, useless};
  if (useless)
    return {false, {}, useless};

  if (found.fault)
    return {false, found.fault};
  if (beside_.add(found.leaves_lane))
    return {false,
            objection{"road", found.beyond_m, limits.most_beyond_soon_m}};
  const auto beyond_m = beyond_line_m(x);
  if (beyond_m > 0.0)
    return {false, objection{"stop_line", *beyond_m, 0}};
  const auto touched = touch(x, found.beside_m);
  if (const auto fault = run_into(x, touched))
    return {false, fault};
  // Waiting costs nothing, and every new source would nudge it on once.
  if (touched && !touched->crosses && x.own.speed_mps < limits.moves_mps)
    return {false, {}, objection{"others", touched->t_s, limits.horizon_s}};
  if (const auto fault = fall_behind(x, passed_s))
    return {false, fault};
  list_margins(begins, found, beyond_m);
  return {};
}

void plan_judge::list_margins(const beginning& begins, const walk& found,
                              std::optional<double> beyond_m) {
  assert(begins.away_m >= 0 && begins.faster_mps >= 0);
  std::size_t n = 0;
  for (const auto& left : {
           margin{"place_m", limits.same_place_m - begins.away_m},
           margin{"speed_off_mps", limits.same_speed_mps - begins.faster_mps},
           margin{"age_s", limits.most_age_s - begins.age_s},
           margin{"road_m", limits.most_beyond_m - found.worst_m},
           margin{"speed_mps", -found.over_mps},
           margin{"along_mps2", limits.most_along_mps2 - found.along_mps2},
           margin{"across_mps2", limits.most_across_mps2 - found.across_mps2},
           margin{"standing_s",
                  limits.most_lost_s - std::max(lost_s_, driven_lost_s_)},
           margin{"braking_s", limits.longest_hard_s - braking_s_},
       })
    room_[n++] = left;
  if (beyond_m)
    room_[n++] = {"stop_line_m", -*beyond_m};
  assert(n <= room_.size());
  margin_count_ = n;
}

// -- where it begins ------------------------------------------------------

plan_judge::beginning plan_judge::look_at_start(const judged_plan& x) {
  const auto t = std::max(x.own.at, x.plan.start);
  const auto first = x.plan.at(t);
  const point heading{std::cos(x.own.heading_rad), std::sin(x.own.heading_rad)};
  const auto here =
      x.own.position + x.own.speed_mps * to_seconds(t - x.own.at) * heading;
  return {distance_m(first.at, here),
          std::abs(first.speed_mps - x.own.speed_mps),
          to_seconds(x.now - x.plan.start)};
}

// What comes too late, twice or to another place, whatever it says then.
std::optional<objection> plan_judge::find_useless(const judged_plan& x,
                                                  const beginning& begins) {
  assert(begins.away_m >= 0 && begins.faster_mps >= 0);
  const auto repeats = is_repeated(x); // which remembers it, too
  if (begins.away_m > limits.same_place_m)
    return objection{"place", begins.away_m, limits.same_place_m};
  if (begins.faster_mps > limits.same_speed_mps)
    return objection{"place", begins.faster_mps, limits.same_speed_mps};
  if (begins.age_s > limits.most_age_s)
    return objection{"age", begins.age_s, limits.most_age_s};
  if (ends_too_soon(x))
    return objection{"length", to_seconds(x.plan.end() - x.now),
                     limits.horizon_s};
  if (repeats)
    return objection{"repetition", 1, 0};
  return std::nullopt;
}

// -- the plan alone -------------------------------------------------------

// The vehicle would stop safely soon, and nobody sees where it leads.
bool plan_judge::ends_too_soon(const judged_plan& x) {
  return to_seconds(x.plan.end() - x.now) < limits.horizon_s
         && x.plan.points.back().speed_mps > limits.moves_mps;
}

plan_judge::walk plan_judge::follow(const judged_plan& x) const {
  walk found;
  const auto& path = x.way.path();
  const auto late_s = to_seconds(x.now - x.plan.start);
  found.worst_m = found.beyond_m = -boundless;
  auto at_first_m = boundless, after_a_second_m = boundless;
  auto first_mps = 0.0, first_s_m = 0.0;
  auto next_s = 0.0;
  auto bounds = x.way.bounds_at(x.plan.points.front().s_m);
  for (const auto& p : x.plan.points) {
    const auto ahead_s = p.t_s - late_s;
    if (ahead_s < next_s)
      continue;
    if (ahead_s > limits.horizon_s)
      break;
    if (ahead_s > limits.soon_s)
      next_s = ahead_s + limits.later_step_s; // the rest comes to be soon
    const auto lane = path.frame(p.s_m);
    if (!bounds.apply_at(p.s_m))
      bounds = x.way.bounds_at(p.s_m);
    const auto d_m = cross(lane.tangent, p.at - lane.at);
    const auto front = p.at + car_.wheelbase_m * axis_of(p.heading_rad, lane);
    const auto under = path.frame(p.s_m + car_.wheelbase_m);
    const auto front_d_m = cross(under.tangent, front - under.at);
    const auto beyond_m =
        car_.width_m / 2 + beyond_sides_m(bounds, d_m, front_d_m);
    found.beside_m = std::max(found.beside_m, std::abs(d_m));
    assert(std::isfinite(beyond_m) && bounds.half_width_m > 0);
    if (at_first_m == boundless) {
      at_first_m = beyond_m;
      first_mps = p.speed_mps;
      first_s_m = p.s_m;
    }
    found.worst_m = std::max(found.worst_m, beyond_m);
    if (ahead_s <= limits.soon_s) {
      found.beyond_m = found.worst_m;
      after_a_second_m = beyond_m;
    }
    const auto limit_mps =
        limits.limit_factor * bounds.limit_mps + limits.above_limit_mps;
    const auto across_mps2 =
        p.speed_mps * p.speed_mps * std::abs(p.curvature_1pm);
    found.along_mps2 = std::max(found.along_mps2, p.accel_mps2);
    found.across_mps2 = std::max(found.across_mps2, across_mps2);
    found.over_mps = std::max(found.over_mps, p.speed_mps - limit_mps);
    if (found.fault)
      continue;
    const auto slowing_mps2 = (first_mps * first_mps - limit_mps * limit_mps)
                              / (2 * std::max(p.s_m - first_s_m, 0.1));
    if (p.speed_mps > limit_mps
        && (slowing_mps2 < limits.slowing_mps2
            || p.speed_mps > first_mps + limits.speeding_up_mps))
      found.fault = {"speed", p.speed_mps, limit_mps};
    else if (p.accel_mps2 > limits.most_along_mps2)
      found.fault = {"along", p.accel_mps2, limits.most_along_mps2};
    else if (across_mps2 > limits.most_across_mps2)
      found.fault = {"across", across_mps2, limits.most_across_mps2};
  }
  for (const auto t : {late_s, late_s + limits.hard_soon_s})
    if (x.plan.at(t).accel_mps2 < limits.hard_mps2)
      found.brakes_hard = true;
  const auto leads_back = after_a_second_m < at_first_m - limits.way_back_m;
  assert(found.beyond_m <= found.worst_m && found.beside_m >= 0);
  found.leaves_lane = found.beyond_m > limits.most_beyond_soon_m && !leads_back;
  if (found.worst_m > limits.most_beyond_m && !found.fault
      && !(leads_back && found.worst_m <= at_first_m + limits.way_back_m))
    found.fault = {"road", found.worst_m, limits.most_beyond_m};
  return found;
}

std::optional<double> plan_judge::beyond_line_m(const judged_plan& x) const {
  if (!x.seen.stop_at_m)
    return std::nullopt;
  const auto line_m = *x.seen.stop_at_m + limits.beyond_line_m;
  const auto v = x.own.speed_mps;
  assert(std::isfinite(line_m) && std::isfinite(v));
  const auto room_m = line_m - (x.s_m + car_.front_m);
  if (room_m <= v * v / (2 * limits.own_line_decel_mps2))
    return std::nullopt; // it cannot stop there any more, whatever the plan
  const auto then =
      x.plan.at(to_seconds(x.now - x.plan.start) + limits.reaction_s);
  const auto stops_at_m =
      then.s_m + car_.front_m
      + then.speed_mps * then.speed_mps / (2 * limits.line_decel_mps2);
  assert(stops_at_m >= then.s_m + car_.front_m);
  return stops_at_m - line_m;
}

bool plan_judge::is_repeated(const judged_plan& x) {
  const auto fingerprint = static_cast<std::uint32_t>(x.fingerprint);
  if (fingerprint == 0)
    return false;
  assert(said_.size() == begins_.size());
  // Mostly it is new: `count`, which the compiler vectorises, takes half the
  // time of `find` then.
  auto repeats = false;
  if (std::ranges::count(said_, fingerprint) > 0) {
    const auto before = std::ranges::find(said_, fingerprint);
    auto& begins = begins_[static_cast<std::size_t>(before - said_.begin())];
    const auto apart_s = std::abs(to_seconds(x.plan.start - begins));
    repeats = apart_s > limits.same_time_s && apart_s < limits.not_back_s;
    if (apart_s >= limits.not_back_s)
      begins = x.plan.start;
  } else {
    if (said_.size() < limits.remembered) {
      said_.resize(limits.remembered);
      begins_.resize(limits.remembered);
    }
    assert(said_.size() == begins_.size() && next_said_ < said_.size());
    said_[next_said_] = fingerprint;
    begins_[next_said_] = x.plan.start;
    next_said_ = (next_said_ + 1) % limits.remembered;
  }
  return repeats && x.own.speed_mps > limits.moves_mps
         && x.plan.points.front().speed_mps > limits.moves_mps;
}

// -- others ---------------------------------------------------------------

// Along the plan for so long, then braking on its line.
std::optional<foreseen_bodies::touch>
plan_judge::first_touch(const judged_plan& x, const world::trajectory& plan,
                        double until_s, double decel_mps2, double kept_gap_m) {
  assert(!plan.empty() && until_s >= 0 && decel_mps2 >= 0);
  motion_.clear();
  const auto late_s = to_seconds(x.now - plan.start);
  // What was seen was seen a little earlier.
  const auto seen_s = to_seconds(x.now - x.seen.at);
  const auto& path = x.way.path();
  double s_m = 0, d_m = 0, v = 0, turned = 0;
  for (double t = 0; t <= limits.horizon_s; t += limits.step_s) {
    if (t <= until_s) {
      const auto p = plan.at(late_s + t);
      const auto lane = path.frame(p.s_m);
      s_m = p.s_m;
      d_m = cross(lane.tangent, p.at - lane.at);
      v = p.speed_mps;
      turned = cross(lane.tangent,
                     {std::cos(p.heading_rad), std::sin(p.heading_rad)});
    } else {
      const auto slower = std::max(0.0, v - decel_mps2 * limits.step_s);
      assert(v >= 0);
      s_m += limits.step_s * (v + slower) / 2;
      v = slower;
    }
    motion_.push_back({t + seen_s, s_m, d_m, turned, v});
  }
  return bodies_.first_touch(motion_, car_, kept_gap_m);
}

std::optional<foreseen_bodies::touch> plan_judge::touch(const judged_plan& x,
                                                        double beside_m) {
  constexpr double margin_m = 0.5; // between the points that were looked at
  const auto until_s = limits.horizon_s + to_seconds(x.now - x.seen.at);
  const auto end_m =
      x.plan.at(to_seconds(x.now - x.plan.start) + limits.horizon_s).s_m;
  if (!bodies_.any_in_reach(end_m - x.s_m + margin_m, beside_m + margin_m,
                            until_s))
    return std::nullopt;
  assert(beside_m >= 0 && until_s > 0);
  const auto touched =
      first_touch(x, x.plan, limits.horizon_s, 0, limits.kept_gap_m);
  // Else there is time to see what it does next.
  const auto soon = touched
                    && first_touch(x, x.plan, limits.reaction_s,
                                   limits.avoiding_mps2, limits.kept_gap_m);
  if (!soon)
    return std::nullopt;
  const auto braking_avoids = !first_touch(x, x.plan, 0, limits.avoiding_mps2);
  const auto going_on_avoids =
      x.in_use && x.in_use->is_sound() && x.in_use->end() > x.now
      && !first_touch(x, *x.in_use, limits.horizon_s, 0);
  if (!braking_avoids && !going_on_avoids)
    return std::nullopt;
  return touched;
}

// A body that crosses may yet turn: it counts when all of the last results
// touch it, and the own plan does not.
std::optional<objection>
plan_judge::run_into(const judged_plan& x,
                     const std::optional<foreseen_bodies::touch>& touched) {
  const auto crosses = touched && touched->crosses;
  crossing_.add(crosses);
  const auto crashes = crossing_.all() && !own_plan_touches(x);
  if (!near_.add(touched && !crosses) && !crashes)
    return std::nullopt;
  assert(touched); // or none of both had failed just now
  return objection{"others", touched->t_s, limits.horizon_s};
}

bool plan_judge::own_plan_touches(const judged_plan& x) {
  return x.own_plan && x.own_plan->is_sound()
         && first_touch(x, *x.own_plan, limits.horizon_s, 0);
}

// -- braking and standing -------------------------------------------------

bool plan_judge::has_reason_to_brake(const judged_plan& x) const {
  const auto v = x.own.speed_mps;
  const auto front_m = x.s_m + car_.front_m;
  const auto near_m = v * limits.brake_reason_s + limits.brake_reason_m;
  assert(v >= 0 && front_m > x.s_m);
  if (x.seen.stop_at_m
      && *x.seen.stop_at_m - front_m < v * v / 4 + limits.brake_reason_m)
    return true;
  if (!x.way.closed()
      && x.way.length_m() - front_m < v * v / 4 + limits.brake_reason_m)
    return true;
  return bodies_.any_ahead(near_m)
         || (!x.crossings_granted
             && bodies_.any_near(near_m, limits.brake_beside_m));
}

std::optional<objection> plan_judge::brake(const judged_plan& x,
                                           bool brakes_hard, double passed_s) {
  assert(passed_s >= 0 && passed_s <= limits.longest_pause_s);
  if (has_reason_to_brake(x))
    braking_s_ = 0;
  else if (brakes_hard)
    braking_s_ += passed_s;
  else
    braking_s_ = std::max(0.0, braking_s_ - passed_s);
  assert(braking_s_ >= 0);
  if (braking_s_ < limits.longest_hard_s)
    return std::nullopt;
  return objection{"braking", braking_s_, limits.longest_hard_s};
}

// What the way alone allows over the next metres.
double plan_judge::free_speed_mps(const judged_plan& x) const {
  constexpr double ahead_m = 20, spacing_m = 5;
  auto free = boundless;
  for (double s = 0; s <= ahead_m; s += spacing_m) {
    const auto at_m = x.s_m + s;
    const auto bend =
        std::max(std::abs(x.way.path().curvature_1pm(at_m)), 1e-6);
    free = std::min({free, x.way.limit_mps(at_m),
                     std::sqrt(limits.comfortable_across_mps2 / bend)});
  }
  assert(free >= 0 && std::isfinite(free));
  return free;
}

// As it drives, and not as plans promise.
bool plan_judge::is_slow(const judged_plan& x) const {
  return x.own.accel_mps2 < limits.speeding_up_mps2
         && x.own.speed_mps < limits.slow_share * free_speed_mps(x);
}

bool plan_judge::wants_own_plan(const judged_plan& x) const {
  const auto due =
      !compared_at_
      || to_seconds(x.now - *compared_at_) >= limits.compared_every_s;
  return (due && is_slow(x)) || crossing_.was_twice();
}

std::optional<objection> plan_judge::fall_behind(const judged_plan& x,
                                                 double passed_s) {
  assert(passed_s >= 0);
  const auto forgiven_s = limits.forgiven_share * passed_s;
  lost_s_ = std::max(0.0, lost_s_ - forgiven_s);
  driven_lost_s_ = std::max(0.0, driven_lost_s_ - forgiven_s);
  settle(x);
  if (x.own_plan && is_slow(x))
    compare(x);
  const auto lost_s = std::max(lost_s_, driven_lost_s_);
  assert(lost_s_ >= 0 && driven_lost_s_ >= 0);
  if (lost_s < limits.most_lost_s)
    return std::nullopt;
  return objection{"standing", lost_s, limits.most_lost_s};
}

// What a plan promises, and from where to look at what is driven.
void plan_judge::compare(const judged_plan& x) {
  assert(x.own_plan);
  const auto since_s =
      compared_at_
          ? std::min(to_seconds(x.now - *compared_at_), limits.compared_every_s)
          : limits.compared_every_s;
  assert(since_s >= 0);
  compared_at_ = x.now;
  if (x.own_plan->empty() || may_wait_beside(x))
    return;
  const auto then = x.now + from_seconds(limits.compared_over_s);
  const auto from_m = x.plan.at(x.now).s_m;
  const auto way_m = x.plan.at(then).s_m - from_m;
  const auto own_way_m = x.own_plan->at(then).s_m - from_m;
  if (own_way_m > limits.least_way_m)
    lost_s_ += since_s * std::clamp(1 - way_m / own_way_m, 0.0, 1.0);
  if (!reference_at_) {
    reference_at_ = x.own.at;
    reference_from_m_ = x.s_m;
    reference_ = *x.own_plan;
  }
}

// How far it has come since, against the own plan of then.
void plan_judge::settle(const judged_plan& x) {
  if (!reference_at_)
    return;
  const auto passed_s = to_seconds(x.own.at - *reference_at_);
  assert(!reference_.empty());
  if (passed_s < limits.driven_for_s)
    return;
  const auto begun = reference_.at(*reference_at_).s_m;
  const auto own_way_m = reference_.at(x.own.at).s_m - begun;
  const auto way_m = x.s_m - reference_from_m_;
  reference_at_.reset();
  if (passed_s > 2 * limits.driven_for_s || may_wait_beside(x)
      || own_way_m < limits.least_driven_m)
    return;
  assert(passed_s >= limits.driven_for_s && own_way_m > 0);
  driven_lost_s_ += passed_s * std::clamp(1 - way_m / own_way_m, 0.0, 1.0);
}

bool plan_judge::may_wait_beside(const judged_plan& x) const {
  return !x.crossings_granted
         && bodies_.any_near(limits.waits_beside_m, limits.waits_beside_m);
}

} // namespace sofof::planners
