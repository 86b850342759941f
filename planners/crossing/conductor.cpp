// Everybody's order, then everybody's drive.
#include "planners/crossing/conductor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

constexpr auto infinity = std::numeric_limits<double>::infinity();

/// Windows are placed so far apart on a way, m.
constexpr double window_every_m = 2;

/// A claim may be driven so much sooner or later, s.
constexpr double rounding_s = 0.05;

/// Nobody stops harder for another order; who has not begun to takes so long
/// and so much way more.
constexpr double stops_mps2 = 2, decides_s = 0.5, spare_m = 1;

/// Slower than this a car sets off, m/s, ...
constexpr double rests_mps = 0.5;

/// ... and a plan is looked for over so many metres.
constexpr int steps = 200;

double stopping_m(double speed_mps) {
  return speed_mps * (decides_s + speed_mps / (2 * stops_mps2)) + spare_m;
}

/// @param way_of  Way of a moment of the motion, rising; m.
/// @param time_of Its time, s.
way_motion motion_of(std::size_t count, auto way_of, auto time_of) {
  std::vector<double> times_s;
  std::size_t k = 0;
  const auto from_m = way_of(0);
  for (auto at_m = from_m; at_m <= way_of(count - 1);
       at_m += way_motion::step_m) {
    while (k + 2 < count && way_of(k + 1) < at_m)
      ++k;
    const auto piece_m = way_of(k + 1) - way_of(k);
    const auto share =
        piece_m > 0 ? std::clamp((at_m - way_of(k)) / piece_m, 0.0, 1.0) : 1.0;
    times_s.push_back(std::lerp(time_of(k), time_of(k + 1), share));
  }
  return times_s.size() < 2 ? way_motion{}
                            : way_motion{from_m, std::move(times_s)};
}

} // namespace

conductor::conductor(crossing_ways ways, const conducting& how,
                     const world::vehicle_params& car)
    : ways_{std::move(ways)}, how_{how}, car_{car} {
  assert(how.looks_ahead_m > 0 && how.sets_off_within_s >= 0);
}

void conductor::plan(time_point now, std::span<const approaching_car> cars,
                     std::vector<crossing_advice>& out) {
  assert(std::ranges::is_sorted(cars, {}, &approaching_car::who));
  gather(now, cars);
  fix_leaders();
  if (!arrange()) { // all claims stay as they are, and others come after them
    for (auto& x : cars_)
      x.is_fixed = x.is_committed
                   || (!x.claimed.empty()
                       && std::ranges::none_of(cars_, [&](const car& y) {
                            return y.claimed.empty() && !y.is_committed
                                   && is_ahead(y, x);
                          }));
    arrange();
  }
  tell(now, out);
}

/// Plans all that is not fixed.
/// @returns whether everybody who claims a drive has one again.
bool conductor::arrange() {
  free_.clear();
  std::vector<std::size_t> before;
  for (std::size_t i = 0; i < cars_.size(); ++i) {
    auto& x = cars_[i];
    x.motion = !x.is_fixed         ? way_motion{}
               : x.claimed.empty() ? x.alone
                                   : x.claimed;
    (x.is_fixed ? before : free_).push_back(i);
  }
  // Lane by lane, the first of each first.
  std::ranges::stable_sort(free_, {}, [&](std::size_t i) {
    const auto& x = cars_[i];
    return std::pair{ways_[x.at.way].lane, x.line_m - x.at.middle_m};
  });
  const auto problem = pose();
  const auto by_arrival = order_of_arrival(problem);
  const auto likely = likely_order(problem);
  const auto& first =
      timed(problem, likely).cost <= timed(problem, by_arrival).cost
          ? likely
          : by_arrival;
  const auto best = search_.solve(problem, first);
  order_.clear();
  auto all = true;
  for (const auto n : best.order) {
    auto& x = cars_[free_[n]];
    order_.push_back(x.is->who);
    x.line_s = best.at_s[n];
    drive(x, before);
    all &= !x.motion.empty() || x.claimed.empty();
    if (!x.motion.empty())
      before.push_back(free_[n]);
  }
  if (all)
    last_order_ = order_;
  assert(order_.size() == free_.size());
  return all;
}

// -- who there is -------------------------------------------------------------

/// @returns way before a crossing on which a car speeds up from rest to what it
/// crosses with.
double conductor::run_up_m(const crossing_way& way) const {
  constexpr double most_m = 25;
  auto slowest_mps = infinity;
  for (auto s_m = way.enters_m; s_m < way.leaves_m; s_m += window_every_m)
    slowest_mps = std::min(slowest_mps, way.way->envelope.limit_mps(s_m));
  return std::min(most_m,
                  slowest_mps * slowest_mps / (2 * how_.alone.accel_mps2));
}

void conductor::gather(time_point now, std::span<const approaching_car> all) {
  cars_.clear();
  std::map<station_id, time_point> wishes;
  for (const auto& one : all) {
    const auto at = ways_.find(one.way, one.s_m, how_.looks_ahead_m);
    if (!at)
      continue;
    const auto& way = ways_[at->way];
    car x{.is = &one,
          .at = *at,
          .line_m = way.enters_m,
          .alone = {}, .claimed = {},
          .motion = {}};
    x.alone = drive_freely(*way.way, how_.alone, at->middle_m, one.speed_mps,
                           std::max(way.leaves_m, at->middle_m)
                               + crossing_ways::behind_m);
    const auto left_m = x.line_m - at->middle_m;
    x.hold_m = std::min(x.line_m, std::max(x.line_m - run_up_m(way),
                                           at->middle_m
                                               + stopping_m(one.speed_mps)));
    windows_.clear();
    if (solve(x))
      x.alone = std::move(x.motion);
    x.motion = {};
    const auto line_s = left_m > 0 ? x.alone.time_s(x.line_m) : 0.0;
    const auto known = wishes_.find(one.who);
    const auto wish =
        known == wishes_.end() ? now + from_seconds(line_s) : known->second;
    wishes.emplace(one.who, wish);
    x.wish_s = std::min(to_seconds(wish - now), line_s);
    if (one.claimed && one.claimed->points.size() >= 2) {
      const auto& plan = *one.claimed;
      const auto more_s = to_seconds(plan.start - now);
      x.claimed = motion_of(
          plan.points.size(),
          [&](std::size_t k) {
            return plan.points[k].s_m + ways_.middle_m() - at->lap_m;
          },
          [&](std::size_t k) { return plan.points[k].t_s + more_s; });
    }
    x.is_committed =
        stopping_m(one.speed_mps) > left_m && one.speed_mps > rests_mps;
    x.is_fixed =
        x.is_committed
        || (!x.claimed.empty()
            && (!one.is_served
                || x.claimed.time_s(x.line_m) < to_seconds(how_.fixed_for)));
    cars_.push_back(std::move(x));
  }
  wishes_ = std::move(wishes);
}

bool conductor::is_ahead(const car& a, const car& b) const {
  return ways_[a.at.way].lane == ways_[b.at.way].lane
         && a.line_m - a.at.middle_m < b.line_m - b.at.middle_m;
}

/// Who drives ahead of a fixed car in its lane does not change either.
void conductor::fix_leaders() {
  for (auto& x : cars_)
    x.is_fixed =
        x.is_fixed
        || (!x.claimed.empty() && std::ranges::any_of(cars_, [&](const car& y) {
             return y.is_fixed && is_ahead(x, y);
           }));
}

// -- the order ----------------------------------------------------------------

kept_apart conductor::gap(const car& first, const car& then) const {
  return ways_.follow(first.at.way, then.at.way)
             ? kept_apart{how_.margins.following_s, how_.margins.following_m}
             : kept_apart{how_.margins.crossing_s, 0};
}

double conductor::lag_s(const car& first, const car& then) {
  const auto& a = first.motion.empty() ? first.alone : first.motion;
  return delay_s(ways_.meet(first.at.way, then.at.way), a, then.alone,
                 gap(first, then))
         + then.alone.time_s(then.line_m) - a.time_s(first.line_m);
}

/// @returns when a car may not be at its line, as a fixed one drives as it
/// does.
std::optional<order_problem::closure> conductor::closure(const car& fixed,
                                                         const car& then) {
  const auto lag = lag_s(fixed, then);
  if (!std::isfinite(lag) || is_ahead(then, fixed))
    return std::nullopt;
  const auto to_s = fixed.motion.time_s(fixed.line_m) + lag;
  if (is_ahead(fixed, then))
    return order_problem::closure{-infinity, to_s};
  const auto late_s = delay_s(ways_.meet(then.at.way, fixed.at.way), then.alone,
                              fixed.motion, gap(then, fixed));
  // The fixed one would have to come later by so much, if positive.
  const auto from_s = then.alone.time_s(then.line_m) - late_s;
  if (!(from_s < to_s))
    return std::nullopt;
  return order_problem::closure{from_s, to_s};
}

order_problem conductor::pose() {
  std::vector<order_problem::car> all;
  std::vector<std::size_t> lanes;
  for (const auto i : free_) {
    const auto& x = cars_[i];
    const auto lane = ways_[x.at.way].lane;
    auto known = std::ranges::find(lanes, lane);
    if (known == lanes.end())
      known = lanes.insert(known, lane);
    order_problem::car it{static_cast<std::size_t>(known - lanes.begin()),
                          x.wish_s,
                          std::max(0.0, x.alone.time_s(x.line_m)),
                          {}};
    for (const auto& fixed : cars_)
      if (fixed.is_fixed)
        if (const auto closed = closure(fixed, x))
          it.closed.push_back(*closed);
    std::ranges::sort(it.closed, {}, &order_problem::closure::from_s);
    std::vector<order_problem::closure> merged;
    for (const auto& c : it.closed)
      if (!merged.empty() && c.from_s <= merged.back().to_s)
        merged.back().to_s = std::max(merged.back().to_s, c.to_s);
      else
        merged.push_back(c);
    it.closed = std::move(merged);
    all.push_back(std::move(it));
  }
  order_problem problem{std::move(all)};
  for (std::size_t a = 0; a < free_.size(); ++a)
    for (std::size_t b = 0; b < free_.size(); ++b)
      if (a != b)
        problem.set_lag(a, b, lag_s(cars_[free_[a]], cars_[free_[b]]));
  return problem;
}

/// @returns the last order, with new cars behind it; each lane's as they come.
std::vector<std::size_t>
conductor::likely_order(const order_problem& problem) const {
  std::vector<std::size_t> order;
  const auto add = [&](std::size_t n) {
    if (std::ranges::find(order, n) == order.end())
      order.push_back(n);
  };
  const auto add_with_leaders = [&](std::size_t n) {
    for (std::size_t m = 0; m <= n; ++m)
      if (problem.cars()[m].lane == problem.cars()[n].lane)
        add(m);
  };
  for (const auto who : last_order_)
    for (std::size_t n = 0; n < free_.size(); ++n)
      if (cars_[free_[n]].is->who == who)
        add_with_leaders(n);
  for (const auto n : order_of_arrival(problem))
    add_with_leaders(n);
  assert(order.size() == problem.size());
  return order;
}

// -- the drives ---------------------------------------------------------------

void conductor::drive(car& x, std::span<const std::size_t> before) {
  list_windows(x, before);
  if (x.is->is_served)
    x.is->speed_mps < rests_mps ? set_off(x) : solve(x);
}

/// @returns whether the search has a car go before a fixed one.
bool conductor::goes_before(const car& x, const car& fixed) {
  if (!fixed.is_fixed || is_ahead(fixed, x))
    return false;
  const auto closed = closure(fixed, x);
  return is_ahead(x, fixed)
         || (closed && x.line_s <= closed->from_s + rounding_s);
}

/// When it may be where, seen from the car.
void conductor::list_windows(const car& x,
                             std::span<const std::size_t> others) {
  windows_.clear();
  std::vector<std::size_t> before;
  for (const auto i : others) {
    const auto& then = cars_[i];
    if (!goes_before(x, then)) {
      before.push_back(i);
      continue;
    }
    const auto apart = gap(x, then);
    const auto& meet = ways_.meet(x.at.way, then.at.way);
    for (auto at_m = then.motion.begins_m(); at_m < then.motion.ends_m();
         at_m += window_every_m) {
      const auto cleared_m = meet.cleared_m(at_m) + apart.by_m;
      if (std::isfinite(cleared_m) && cleared_m > x.at.middle_m)
        windows_.push_back(
            {cleared_m - x.at.middle_m, -infinity,
             then.motion.time_s(at_m) - apart.by_s + rounding_s});
    }
  }
  const auto to_m = ways_[x.at.way].leaves_m + window_every_m;
  for (auto at_m = x.at.middle_m; at_m < to_m; at_m += window_every_m) {
    speed_constraints::window w{at_m - x.at.middle_m};
    for (const auto i : before) {
      const auto& first = cars_[i];
      const auto apart = gap(first, x);
      const auto cleared_m =
          ways_.meet(first.at.way, x.at.way).cleared_m(at_m) + apart.by_m;
      if (std::isfinite(cleared_m) && cleared_m > first.motion.begins_m())
        w.earliest_s =
            std::max(w.earliest_s, first.motion.time_s(cleared_m) + apart.by_s
                                       - rounding_s);
    }
    if (w.earliest_s > 0)
      windows_.push_back(w);
  }
}

planned_path conductor::centre_line(const car& x) const {
  planned_path path;
  const auto& line = ways_[x.at.way].way->line;
  path.start_s_m = x.at.middle_m - ways_.middle_m();
  path.ds_m = 1;
  path.size = std::min(steps, planned_path::capacity);
  for (int k = 0; k < path.size; ++k)
    path.knots[static_cast<std::size_t>(k)].x = {
        0, 0, line.curvature_1pm(path.start_s_m + k * path.ds_m)};
  path.measure([&](double s_m) { return line.curvature_1pm(s_m); });
  return path;
}

/// @returns whether it can drive within the windows, from where it is.
bool conductor::solve(car& x) {
  speed_planner planner{ways_[x.at.way].way, how_.style, {1, steps - 10}};
  speed_constraints task;
  task.speed_mps = x.is->speed_mps;
  task.accel_mps2 = x.is->accel_mps2;
  task.windows = windows_;
  const auto result = planner.plan(centre_line(x), 0, task);
  const auto& motion = planner.motion();
  if (result.emergency || motion.size() < 2
      || result.how != speed_mode::optimal)
    return false;
  x.motion = motion_of(
      motion.size(),
      [&](std::size_t k) { return motion[k].s_m + x.at.middle_m; },
      [&](std::size_t k) {
        return static_cast<double>(k) * how_.style.step_s;
      });
  const auto whole =
      !x.motion.empty() && x.motion.ends_m() >= ways_[x.at.way].leaves_m;
  if (!whole)
    x.motion = {};
  return whole;
}

/// @returns whether it holds up the crossing for longer than if it had waited
/// before it: it drifts onto it at walking pace.
bool conductor::is_slow(const car& x) const {
  const auto& way = ways_[x.at.way];
  if (x.at.middle_m > x.hold_m - 1 || x.is->speed_mps < rests_mps)
    return false; // there is no better place any more
  constexpr double share = 1.4;
  const auto well = drive_freely(*way.way, how_.alone,
                                 way.enters_m - run_up_m(way), 0,
                                 way.leaves_m + 1);
  const auto takes_s = [&](const way_motion& m) {
    return m.time_s(way.leaves_m) - m.time_s(way.enters_m);
  };
  return takes_s(x.motion) > share * takes_s(well);
}

/// From rest: as if alone, so much later that it keeps to the windows.
bool conductor::set_off(car& x) {
  auto windows = std::move(windows_);
  windows_.clear();
  const auto can = solve(x);
  windows_ = std::move(windows);
  if (!can)
    return false;
  auto later_s = 0.0;
  for (const auto& w : windows_)
    later_s = std::max(later_s,
                       w.earliest_s - x.motion.time_s(w.at_m + x.at.middle_m));
  const auto in_time = std::ranges::all_of(windows_, [&](const auto& w) {
    return x.motion.time_s(w.at_m + x.at.middle_m) + later_s <= w.latest_s;
  });
  x.motion = in_time && later_s <= how_.sets_off_within_s
                 ? x.motion.later(later_s)
                 : way_motion{};
  return !x.motion.empty();
}

// -- what is told -------------------------------------------------------------

void conductor::tell(time_point now, std::vector<crossing_advice>& out) {
  out.clear();
  for (const auto i : free_) {
    const auto& x = cars_[i];
    if (!x.is->is_served)
      continue;
    const auto& way = ways_[x.at.way];
    const auto& line = way.way->line.way();
    crossing_advice a{x.is->who,
                      {},
                      x.hold_m - ways_.middle_m() + x.at.lap_m,
                      now + from_seconds(x.line_s)};
    if (!x.motion.empty()) {
      // Equal steps in time.
      auto at_m = x.motion.begins_m();
      const auto begin_s = x.motion.time_s(at_m);
      const auto end_s = x.motion.time_s(way.leaves_m);
      a.drive.start = now + from_seconds(begin_s);
      const auto count =
          std::max(1.0, std::ceil((end_s - begin_s) / how_.style.step_s));
      const auto step_s = (end_s - begin_s) / count;
      for (auto k = 0.0; k <= count; ++k) {
        const auto t = begin_s + k * step_s;
        while (at_m < way.leaves_m && x.motion.time_s(at_m) < t)
          at_m += 0.05;
        const auto s_m = at_m - ways_.middle_m();
        const auto p = line.path().at(s_m);
        const auto v =
            1 / (x.motion.time_s(at_m + 0.5) - x.motion.time_s(at_m - 0.5));
        a.drive.points.push_back({k * step_s, s_m + x.at.lap_m, p.at,
                                  p.heading_rad, p.curvature_1pm, v, 0});
      }
    }
    out.push_back(std::move(a));
  }
  assert(out.size() <= free_.size());
}

} // namespace sofof::planners
