// Everybody's order, then everybody's drive.
#include "planners/crossing/conductor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace sofof::planners {
namespace {

constexpr auto infinity = std::numeric_limits<double>::infinity();

/// A drive ends so far behind its crossing, m.
constexpr double beyond_m = 10;

/// A claim may be driven so much sooner or later, s.
constexpr double rounding_s = 0.05;
constexpr double sooner_s = 1, off_s = 0.4;

/// Nobody stops harder for another order; who has not begun to takes so long
/// and so much way more.
constexpr double stops_mps2 = 2, decides_s = 0.5, spare_m = 1;

/// Slower than this a car stands, m/s.
constexpr double rests_mps = 0.5;

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
    : ways_{std::move(ways)}, how_{how}, car_{car}, drives_{how.alone} {
  assert(how.looks_ahead_m > 0 && how.sets_off_within_s >= 0);
}

void conductor::plan(time_point now, std::span<const approaching_car> cars,
                     std::vector<crossing_advice>& out) {
  assert(std::ranges::is_sorted(cars, {}, &approaching_car::who));
  gather(now, cars);
  fix_leaders();
  if (!arrange()) { // all drives stay as they are, and others come after them
    ++kept;
    for (auto& x : cars_)
      x.is_fixed = x.is_committed || !x.claimed.empty();
    if (!arrange()) {
      ++failed;
      std::erase_if(free_, [&](std::size_t i) { return cars_[i].motion.empty(); });
    }
  }
  tell(now, out);
}

/// Plans all that is not fixed.
/// @returns whether everybody who claims a drive has one again.
bool conductor::arrange() {
  free_.clear();
  for (std::size_t i = 0; i < cars_.size(); ++i) {
    auto& x = cars_[i];
    x.motion = !x.is_fixed         ? way_motion{}
               : x.claimed.empty() ? x.alone
                                   : x.claimed;
    if (!x.is_fixed)
      free_.push_back(i);
  }
  // Lane by lane, the first of each first.
  std::ranges::stable_sort(free_, {}, [&](std::size_t i) {
    const auto& x = cars_[i];
    return std::pair{ways_[x.at.way].lane, left_m(x)};
  });
  const auto problem = pose();
  const auto by_arrival = order_of_arrival(problem);
  const auto likely = likely_order(problem);
  const auto& first =
      timed(problem, likely).cost <= timed(problem, by_arrival).cost
          ? likely
          : by_arrival;
  const auto& best = search_.solve(problem, first);
  const auto is_driven = drive_all(best.order, &best.at_s)
                         || drive_all(best.order, nullptr)
                         || drive_all(likely, nullptr);
  if (!is_driven)
    return false;
  last_order_ = order_;
  return true;
}

/// @returns whether all that are not fixed can drive in this order.
bool conductor::drive_all(std::span<const std::size_t> order,
                          const std::vector<double>* at_s) {
  std::vector<std::size_t> before;
  for (std::size_t i = 0; i < cars_.size(); ++i)
    if (cars_[i].is_fixed)
      before.push_back(i);
  order_.clear();
  for (const auto n : order) {
    auto& x = cars_[free_[n]];
    order_.push_back(x.is->who);
    x.line_s = at_s ? (*at_s)[n] : 0;
    if (!drive(x, before, at_s != nullptr)) {
      if (std::getenv("WHY")) {
        std::printf("cannot: %u v %.2f a %.2f to line %.2f, attempt %d, done %zu of %zu;", x.is->who.value(), x.is->speed_mps, x.is->accel_mps2, x.line_m - x.at.middle_m, at_s ? 1 : 2, before.size(), cars_.size());
        for (std::size_t k = 0; k < earliest_s_.size(); ++k)
          if (earliest_s_[k] > 0 || latest_s_[k] < 100) std::printf(" %zu:%.1f..%.1f", k, earliest_s_[k], latest_s_[k]);
        std::printf("\n");
        for (auto i : before) { auto& o = cars_[i]; auto g = gap(o, x); auto& m = ways_.meet(o.at.way, x.at.way); double c = m.cleared_m(x.at.middle_m + 1) + g.by_m; if (std::isfinite(c) && c > o.motion.begins_m()) std::printf("  by %u v %.1f to line %.1f, same lane %d, fixed %d, ahead %d, must be at %.1f is at %.1f, then %.1f\n", o.is->who.value(), o.is->speed_mps, o.line_m - o.at.middle_m, ways_[o.at.way].lane == ways_[x.at.way].lane, o.is_fixed, is_ahead(o, x), c, o.at.middle_m, o.motion.time_s(c)); }
      }
      return false;
    }
    before.push_back(free_[n]);
  }
  return true;
}

// -- who there is -------------------------------------------------------------

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
    x.is_fixed = x.is_committed || (!x.claimed.empty() && (one.is_fixed || !one.is_served));
    cars_.push_back(std::move(x));
  }
  wishes_ = std::move(wishes);
}

/// @returns way to the end of the lane on which it comes, m; negative: past it.
double conductor::left_m(const car& x) const {
  return ways_[x.at.way].lane_ends_m - x.at.middle_m;
}

bool conductor::is_ahead(const car& a, const car& b) const {
  return ways_[a.at.way].lane == ways_[b.at.way].lane && left_m(a) < left_m(b);
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

/// @returns whether it has a drive within what the others leave free.
bool conductor::drive(car& x, std::span<const std::size_t> before,
                      bool may_slip_in) {
  if (!x.is->is_served)
    return true;
  list_windows(x, before, may_slip_in);
  const auto found = drives_.find(
      *ways_[x.at.way].way,
      {x.at.middle_m, x.is->speed_mps, x.is->accel_mps2, x.line_m, earliest_s_, latest_s_}, x.motion);
  if (is_kept(x) && (!found || x.claimed.time_s(ways_[x.at.way].leaves_m) < x.motion.time_s(ways_[x.at.way].leaves_m) + sooner_s)) {
    x.motion = x.claimed;
    return true;
  }
  return found;
}

/// @returns whether it can drive on as it does.
bool conductor::is_kept(const car& x) const {
  if (x.claimed.empty() || x.claimed.ends_m() < ways_[x.at.way].leaves_m)
    return false;
  if (x.claimed.begins_m() < x.at.middle_m - 0.1 && std::abs(x.claimed.time_s(x.at.middle_m)) > off_s && x.is->speed_mps > rests_mps)
    return false;
  for (std::size_t k = 1; k < earliest_s_.size(); ++k) {
    const auto t = x.claimed.time_s(x.at.middle_m + static_cast<double>(k) * window_drive::step_m);
    if (t < earliest_s_[k] - 2 * rounding_s || t > latest_s_[k] + 2 * rounding_s)
      return false;
  }
  return true;
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
void conductor::list_windows(const car& x, std::span<const std::size_t> others,
                             bool may_slip_in) {
  const auto way_m =
      std::max(ways_[x.at.way].leaves_m - x.at.middle_m, 0.0) + beyond_m;
  const auto count = static_cast<std::size_t>(way_m / window_drive::step_m) + 2;
  earliest_s_.assign(count, -infinity);
  latest_s_.assign(count, infinity);
  const auto place_m = [&](std::size_t k) {
    return x.at.middle_m + static_cast<double>(k) * window_drive::step_m;
  };
  const auto stop_m = 3 + x.is->speed_mps * x.is->speed_mps
                              / (2 * how_.alone.decel_mps2);
  for (const auto i : others) {
    const auto& other = cars_[i];
    if (may_slip_in && goes_before(x, other)) {
      const auto apart = gap(x, other);
      const auto& meet = ways_.meet(x.at.way, other.at.way);
      for (auto at_m = other.motion.begins_m(); at_m < other.motion.ends_m();
           at_m += window_drive::step_m) {
        const auto cleared_m = meet.cleared_m(at_m) + apart.by_m;
        if (!std::isfinite(cleared_m) || cleared_m <= x.at.middle_m)
          continue;
        const auto k = static_cast<std::size_t>(
            std::ceil((cleared_m - x.at.middle_m) / window_drive::step_m));
        if (k < count)
          latest_s_[k] = std::min(latest_s_[k], other.motion.time_s(at_m)
                                                    - apart.by_s + rounding_s);
      }
      continue;
    }
    const auto apart = gap(other, x);
    const auto& meet = ways_.meet(other.at.way, x.at.way);
    for (std::size_t k = 1; k < count; ++k) {
      // Within its stopping distance, only the distance counts.
      const auto is_close =
          ways_[other.at.way].lane == ways_[x.at.way].lane
          && place_m(k) < x.at.middle_m + stop_m;
      const auto cleared_m =
          meet.cleared_m(place_m(k)) + (is_close ? std::min(1.0, apart.by_m) : apart.by_m);
      if (!std::isfinite(cleared_m) || cleared_m <= other.motion.begins_m())
        continue;
      earliest_s_[k] =
          std::max(earliest_s_[k], other.motion.time_s(cleared_m)
                                       + (is_close ? 0 : apart.by_s)
                                       - rounding_s);
    }
  }
  for (auto k = count - 1; k-- > 0;)
    latest_s_[k] = std::min(latest_s_[k], latest_s_[k + 1]);
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
                      x.line_m - ways_.middle_m() + x.at.lap_m,
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
            std::min(20.0, 1 / std::max(0.05, x.motion.time_s(at_m + 0.5) - x.motion.time_s(at_m - 0.5)));
        a.drive.points.push_back({k * step_s, s_m + x.at.lap_m, p.at,
                                  p.heading_rad, p.curvature_1pm, v, 0});
      }
    }
    out.push_back(std::move(a));
  }
  assert(out.size() <= free_.size());
}

} // namespace sofof::planners
