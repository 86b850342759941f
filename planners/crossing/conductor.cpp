// Everybody's order, then everybody's drive.
#include "planners/crossing/conductor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::planners {
namespace {

constexpr auto at_no_time = std::numeric_limits<double>::infinity();

/// A drive is told until so far behind its crossing, m.
constexpr double told_behind_m = 10;

/// A drive that was told stays if a new one is not sooner by this, the car is
/// where it says to within this, and it keeps its windows to within this; s.
constexpr double worth_telling_s = 1, as_told_s = 0.4, kept_within_s = 0.1;

/// Who is farther from where its drive is does not drive so, m.
constexpr double drives_so_within_m = 5;

/// Who comes to its line before a fixed one to within this slips in; s.
constexpr double slips_in_s = 0.05;

/// Who brakes like this, after so long, cannot stop before its line any more.
constexpr double line_brakes_mps2 = 2, line_decides_s = 0.5, line_spare_m = 1;

/// Slower than this a car stands, m/s.
constexpr double car_rests_mps = 0.5;

constexpr double told_every_s = 0.1;
constexpr double told_most_mps2 = 3;

/// Motions of half metres have jolts that cars cannot follow: what is told
/// changes its speed by no more, and is elsewhere for a moment instead.
constexpr double told_change_mps2 = 4;

double line_stopping_m(double speed_mps) {
  return speed_mps * (line_decides_s + speed_mps / (2 * line_brakes_mps2))
         + line_spare_m;
}

/// @returns what a trajectory is of the middle of a body.
way_motion motion_of(const world::trajectory& drive, time_point now,
                     double from_axle_m) {
  assert(drive.points.size() >= 2 && std::isfinite(from_axle_m));
  const auto& all = drive.points;
  const auto more_s = to_seconds(drive.start - now);
  std::vector<double> times_s;
  std::size_t k = 0;
  const auto from_m = all.front().s_m + from_axle_m;
  for (auto at_m = from_m; at_m <= all.back().s_m + from_axle_m;
       at_m += way_motion::step_m) {
    while (k + 2 < all.size() && all[k + 1].s_m + from_axle_m < at_m)
      ++k;
    const auto piece_m = all[k + 1].s_m - all[k].s_m;
    const auto share =
        piece_m > 0
            ? std::clamp((at_m - all[k].s_m - from_axle_m) / piece_m, 0.0, 1.0)
            : 1.0;
    times_s.push_back(more_s + std::lerp(all[k].t_s, all[k + 1].t_s, share));
  }
  assert(std::ranges::is_sorted(times_s));
  return times_s.size() < 2 ? way_motion{}
                            : way_motion{from_m, std::move(times_s)};
}

/// Joins those that overlap.
std::vector<order_problem::closure>
joined_closures(std::vector<order_problem::closure> all) {
  std::ranges::sort(all, {}, &order_problem::closure::from_s);
  std::vector<order_problem::closure> merged;
  for (const auto& x : all)
    if (!merged.empty() && x.from_s <= merged.back().to_s)
      merged.back().to_s = std::max(merged.back().to_s, x.to_s);
    else
      merged.push_back(x);
  return merged;
}

} // namespace

conductor::conductor(crossing_ways ways, const conducting& how)
    : ways_{std::move(ways)}, how_{how}, spacing_{ways_, how.margins},
      drives_{how.alone} {
  assert(how.looks_ahead_m > 0);
}

void conductor::plan(time_point now, std::span<const approaching_car> cars,
                     std::vector<crossing_advice>& out) {
  assert(std::ranges::is_sorted(cars, {}, &approaching_car::who));
  gather(now, cars);
  fix_leaders();
  if (!arrange()) { // what was told stays, and others come after that
    for (auto& x : cars_)
      x.is_fixed = x.is_fixed || !x.told.empty();
    arrange();
  }
  assert(free_.size() <= cars_.size());
  tell(now, out);
}

// -- who there is -------------------------------------------------------------

void conductor::gather(time_point now, std::span<const approaching_car> all) {
  assert(how_.looks_ahead_m > 0);
  cars_.clear();
  std::map<station_id, time_point> wishes;
  for (const auto& one : all)
    if (const auto at = ways_.find(one.way, one.s_m, how_.looks_ahead_m)) {
      assert(one.speed_mps >= 0 && one.way);
      cars_.push_back(make_approach(now, one, *at));
      auto& x = cars_.back();
      const auto line_s =
          std::max(0.0, x.alone.time_s(ways_[at->way].enters_m));
      const auto known = wishes_.find(one.who);
      const auto wish =
          known == wishes_.end() ? now + from_seconds(line_s) : known->second;
      wishes.emplace(one.who, wish);
      x.wish_s = std::min(to_seconds(wish - now), line_s);
    }
  assert(cars_.size() <= all.size() && wishes.size() == cars_.size());
  wishes_ = std::move(wishes);
}

approach conductor::make_approach(time_point now, const approaching_car& one,
                                  const crossing_ways::place& at) const {
  assert(one.speed_mps >= 0 && std::isfinite(one.accel_mps2));
  assert(std::isfinite(at.middle_m));
  const auto& way = ways_[at.way];
  approach x{.is = &one, .at = at, .alone = {}, .told = {}, .motion = {}};
  x.alone = drive_freely(*way.way, how_.alone, at.middle_m, one.speed_mps,
                         std::max(way.leaves_m, at.middle_m)
                             + crossing_ways::behind_m);
  assert(!x.alone.empty());
  if (one.drive && one.drive->points.size() >= 2)
    x.told = motion_of(*one.drive, now, ways_.middle_m() - at.lap_m);
  if (!x.told.empty()
      && std::abs(x.told.place_m(0) - at.middle_m) > drives_so_within_m)
    x.told = {};
  const auto can_stop =
      one.speed_mps <= car_rests_mps
      || line_stopping_m(one.speed_mps) <= way.enters_m - at.middle_m;
  x.is_fixed =
      !can_stop || !one.is_served || (one.has_claimed && !x.told.empty());
  return x;
}

/// Who drives ahead of a fixed car in its lane does not change either.
void conductor::fix_leaders() {
  for (auto& x : cars_)
    x.is_fixed =
        x.is_fixed
        || (!x.told.empty() && std::ranges::any_of(cars_, [&](const auto& y) {
             return y.is_fixed && spacing_.is_ahead(x, y);
           }));
}

// -- the order ----------------------------------------------------------------

/// Plans all that is not fixed.
/// @returns whether each of them has a drive.
bool conductor::arrange() {
  free_.clear();
  for (std::size_t i = 0; i < cars_.size(); ++i) {
    auto& x = cars_[i];
    x.motion = !x.is_fixed ? way_motion{} : x.told.empty() ? x.alone : x.told;
    if (!x.is_fixed)
      free_.push_back(i);
  }
  // Lane by lane, the first of each first.
  std::ranges::stable_sort(free_, {}, [&](std::size_t i) {
    return std::pair{ways_[cars_[i].at.way].lane, spacing_.left_m(cars_[i])};
  });
  const auto problem = pose();
  assert(problem.size() == free_.size());
  const auto by_arrival = order_of_arrival(problem);
  const auto likely = likely_order(problem);
  const auto& first =
      timed(problem, likely).cost <= timed(problem, by_arrival).cost
          ? likely
          : by_arrival;
  const auto& best = search_.solve(problem, first);
  assert(best.order.size() == free_.size());
  assert(best.at_s.size() == free_.size());
  const auto is_driven = drive_all(best.order, &best.at_s)
                         || drive_all(best.order, nullptr)
                         || drive_all(likely, nullptr);
  if (is_driven)
    last_order_ = order_;
  return is_driven;
}

std::vector<order_problem::closure> conductor::closures(const approach& x) {
  std::vector<order_problem::closure> all;
  for (const auto& fixed : cars_)
    if (fixed.is_fixed)
      if (const auto closed = spacing_.closure(fixed, x))
        all.push_back(*closed);
  return joined_closures(std::move(all));
}

order_problem conductor::pose() {
  assert(std::ranges::all_of(free_, [&](auto i) { return i < cars_.size(); }));
  std::vector<order_problem::car> all;
  std::vector<std::size_t> lanes;
  for (const auto i : free_) {
    const auto& x = cars_[i];
    const auto& way = ways_[x.at.way];
    auto known = std::ranges::find(lanes, way.lane);
    if (known == lanes.end())
      known = lanes.insert(known, way.lane);
    all.push_back({static_cast<std::size_t>(known - lanes.begin()), x.wish_s,
                   std::max(0.0, x.alone.time_s(way.enters_m)), closures(x)});
  }
  assert(all.size() == free_.size() && lanes.size() <= all.size());
  order_problem problem{std::move(all)};
  for (std::size_t a = 0; a < free_.size(); ++a)
    for (std::size_t b = 0; b < free_.size(); ++b)
      if (a != b)
        problem.set_lag(a, b, spacing_.lag_s(cars_[free_[a]], cars_[free_[b]]));
  assert(problem.size() == free_.size());
  return problem;
}

/// @returns the last order, with new cars behind it; each lane's as they come.
std::vector<std::size_t>
conductor::likely_order(const order_problem& problem) const {
  assert(problem.size() == free_.size());
  std::vector<std::size_t> order;
  const auto add_with_leaders = [&](std::size_t n) {
    for (std::size_t m = 0; m <= n; ++m)
      if (problem.cars()[m].lane == problem.cars()[n].lane
          && std::ranges::find(order, m) == order.end())
        order.push_back(m);
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

/// @param at_s  When the search has them at their lines; null: in this order,
///              and all after those that are fixed.
/// @returns whether all that are not fixed can drive so.
bool conductor::drive_all(std::span<const std::size_t> order,
                          const std::vector<double>* at_s) {
  assert(order.size() == free_.size());
  assert(!at_s || at_s->size() == order.size());
  std::vector<std::size_t> before;
  for (std::size_t i = 0; i < cars_.size(); ++i)
    if (cars_[i].is_fixed)
      before.push_back(i);
  for (const auto i : free_)
    cars_[i].motion = {};
  order_.clear();
  for (const auto n : order) {
    auto& x = cars_[free_[n]];
    order_.push_back(x.is->who);
    x.line_s = at_s ? (*at_s)[n] : 0;
    if (!drive(x, before, at_s != nullptr))
      return false;
    assert(!x.motion.empty());
    before.push_back(free_[n]);
  }
  return true;
}

bool conductor::drive(approach& x, std::span<const std::size_t> before,
                      bool may_slip_in) {
  const auto& way = ways_[x.at.way];
  assert(x.is && !x.is_fixed);
  list_windows(x, before, may_slip_in);
  const auto is_found =
      drives_.find(*way.way,
                   {x.at.middle_m, x.is->speed_mps, x.is->accel_mps2,
                    way.enters_m, windows_.earliest_s, windows_.latest_s},
                   x.motion);
  assert(windows_.earliest_s.size() == windows_.latest_s.size());
  assert(!is_found || !x.motion.empty());
  if (is_kept(x)
      && (!is_found
          || x.told.time_s(way.leaves_m)
                 < x.motion.time_s(way.leaves_m) + worth_telling_s)) {
    x.motion = x.told;
    x.is_as_told = true;
    return true;
  }
  x.is_as_told = false;
  return is_found;
}

/// @returns whether it can go on as it was told, within the windows.
bool conductor::is_kept(const approach& x) const {
  assert(windows_.earliest_s.size() == windows_.latest_s.size());
  assert(std::isfinite(x.at.middle_m));
  if (x.told.empty() || x.told.ends_m() < ways_[x.at.way].leaves_m
      || (x.is->speed_mps > car_rests_mps
          && std::abs(x.told.time_s(x.at.middle_m)) > as_told_s))
    return false;
  for (std::size_t k = 1; k < windows_.earliest_s.size(); ++k) {
    const auto t = x.told.time_s(
        x.at.middle_m + static_cast<double>(k) * window_drive::step_m);
    if (t < windows_.earliest_s[k] - kept_within_s
        || t > windows_.latest_s[k] + kept_within_s)
      return false;
  }
  return true;
}

/// @returns whether the search has a car go before a fixed one.
bool conductor::goes_before(const approach& x, const approach& fixed) {
  if (!fixed.is_fixed || spacing_.is_ahead(fixed, x))
    return false;
  const auto closed = spacing_.closure(fixed, x);
  return spacing_.is_ahead(x, fixed)
         || (closed && x.line_s <= closed->from_s + slips_in_s);
}

void conductor::list_windows(const approach& x,
                             std::span<const std::size_t> others,
                             bool may_slip_in) {
  const auto way_m =
      std::max(ways_[x.at.way].leaves_m - x.at.middle_m, 0.0) + told_behind_m;
  const auto count =
      static_cast<std::size_t>(std::ceil(way_m / window_drive::step_m)) + 2;
  assert(way_m > 0 && count >= 2);
  windows_.earliest_s.assign(count, -at_no_time);
  windows_.latest_s.assign(count, at_no_time);
  assert(std::ranges::none_of(others,
                              [&](std::size_t i) { return &cars_[i] == &x; }));
  for (const auto i : others)
    if (may_slip_in && goes_before(x, cars_[i]))
      spacing_.go_before(cars_[i], x, windows_);
    else
      spacing_.go_after(cars_[i], x, windows_);
}

// -- what is told -------------------------------------------------------------

void conductor::tell(time_point now, std::vector<crossing_advice>& out) {
  out.clear();
  for (const auto i : free_)
    if (const auto& x = cars_[i]; x.is->is_served)
      out.push_back({x.is->who, x.motion.empty() ? world::trajectory{}
                                : x.is_as_told   ? *x.is->drive
                                                 : written(now, x)});
  for (const auto& x : cars_)
    if (x.is_fixed && x.is->is_served && x.told.empty())
      out.push_back({x.is->who, {}});
  assert(out.size() <= cars_.size());
}

/// @returns a motion as a trajectory: points at equal steps in time.
world::trajectory conductor::written(time_point now, const approach& x) const {
  const auto& way = ways_[x.at.way];
  const auto& line = way.way->line.way();
  const auto begin_s = x.motion.time_s(x.motion.begins_m());
  const auto end_s = x.motion.time_s(
      std::min(x.motion.ends_m(), way.leaves_m + told_behind_m / 2));
  assert(!x.motion.empty() && begin_s <= end_s);
  const auto speed_mps = [&](double t) {
    const auto from = std::max(begin_s, t - told_every_s);
    const auto to = std::min(end_s, t + told_every_s);
    return (x.motion.place_m(to) - x.motion.place_m(from)) / (to - from);
  };
  world::trajectory drive;
  drive.start = now + from_seconds(begin_s);
  constexpr auto most = told_change_mps2 * told_every_s;
  auto s_m = x.motion.place_m(begin_s) - ways_.middle_m();
  auto v = speed_mps(begin_s);
  for (auto k = 0; begin_s + k * told_every_s <= end_s; ++k) {
    const auto t = begin_s + k * told_every_s;
    const auto wanted_m = x.motion.place_m(t) - ways_.middle_m();
    if (k > 0) {
      const auto least_mps = std::max(0.0, v - most), most_mps = v + most;
      v = std::clamp(speed_mps(t), least_mps, most_mps);
      s_m = std::clamp(wanted_m, s_m + least_mps * told_every_s,
                       s_m + most_mps * told_every_s);
    }
    const auto p = line.path().at(s_m);
    const auto accel_mps2 =
        (speed_mps(t + told_every_s / 2) - speed_mps(t - told_every_s / 2))
        / told_every_s;
    drive.points.push_back(
        {k * told_every_s, s_m + x.at.lap_m, p.at, p.heading_rad,
         p.curvature_1pm, v,
         std::clamp(accel_mps2, -told_most_mps2, told_most_mps2)});
  }
  assert(!drive.points.empty());
  assert(std::isfinite(s_m) && v >= 0);
  return drive;
}

} // namespace sofof::planners
