// Reachable times, place by place; then one drive, read backwards.
#include "planners/crossing/window_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace sofof::planners {
namespace {

constexpr auto infinity = std::numeric_limits<double>::infinity();
constexpr double level_m2ps2 = 0.5; // of v²/2
constexpr std::size_t levels = 240; // to 15.5 m/s
constexpr auto parts = static_cast<std::size_t>(window_drive::step_m / way_motion::step_m);
constexpr double set_off_s = 0.6; // by which jerk delays it

} // namespace

window_drive::window_drive(const free_drive_limits& limits)
    : up_{static_cast<std::size_t>(limits.accel_mps2 * step_m / level_m2ps2)},
      down_{static_cast<std::size_t>(limits.decel_mps2 * step_m
                                     / level_m2ps2)} {
  assert(up_ > 0 && down_ > 0);
  for (std::size_t l = 0; l < levels; ++l)
    speeds_.push_back(std::sqrt(2 * static_cast<double>(l) * level_m2ps2));
}

bool window_drive::find(const route_profile& way, const task& what,
                        way_motion& out) {
  assert(what.earliest_s.size() >= 2
         && what.earliest_s.size() == what.latest_s.size());
  for (const auto harder : {0, 2}) {
    begin(what, harder == 0);
    bound(way, what);
    if (first_ + 1 >= what.earliest_s.size())
      continue;
    down_ += harder;
    reach(what);
    const auto is = read_back(what, out);
    down_ -= harder;
    if (is)
      return true;
  }
  return false;
}

/// What a car has of acceleration fades out first.
void window_drive::begin(const task& what, bool smoothly) {
  constexpr double jerk_mps3 = 1.6, step_s = 0.05;
  prefix_.clear();
  auto s = 0.0, v = what.speed_mps, a = smoothly ? what.accel_mps2 : 0.0, t = 0.0;
  auto next = 0.5;
  while (std::abs(a) > 0.05 && v > 0) {
    const auto then = a > 0 ? std::max(0.0, a - jerk_mps3 * step_s)
                            : std::min(0.0, a + jerk_mps3 * step_s);
    const auto u = std::max(0.0, v + (a + then) / 2 * step_s);
    const auto ds = (v + u) / 2 * step_s;
    while (s + ds >= next) {
      prefix_.push_back(t + step_s * (next - s) / ds);
      next += 0.5;
    }
    s += ds;
    v = u;
    a = then;
    t += step_s;
  }
  begin_m_ = s;
  begin_mps_ = v;
  begin_s_ = t;
  begin_w_ = v * v / 2;
  first_ = static_cast<std::size_t>(s / step_m) + 1;
}

/// As fast as the way allows; a car that is faster brakes.
void window_drive::bound(const route_profile& way, const task& what) {
  const auto count = what.earliest_s.size();
  top_.resize(count);
  for (auto k = count; k-- > 0;) {
    const auto most =
        way.envelope.limit_mps(what.s_m + static_cast<double>(k) * step_m);
    top_[k] = std::min(levels - 1, static_cast<std::size_t>(
                                       most * most / 2 / level_m2ps2 + 1e-9));
    if (k + 1 < count)
      top_[k] = std::min(top_[k], top_[k + 1] + down_);
  }
  const auto now =
      std::min(levels - 1, static_cast<std::size_t>(begin_w_ / level_m2ps2));
  for (std::size_t k = 0; first_ + k < count && k * down_ <= now; ++k)
    top_[first_ + k] = std::max(top_[first_ + k], now - k * down_);
}

void window_drive::reach(const task& what) {
  const auto count = what.earliest_s.size();
  for (auto& states : states_)
    states.assign(count * levels, {1, 0});
  const auto take = [&](has_stood how, std::size_t k, std::size_t l,
                        double from_s, double to_s) {
    from_s = std::max(from_s, what.earliest_s[k]);
    to_s = std::min(to_s, what.latest_s[k]);
    if (from_s <= to_s)
      at(how, k, l) = {static_cast<float>(from_s), static_cast<float>(to_s)};
  };
  // From where it is, with the speed that it has.
  const auto here = begin_w_ / level_m2ps2;
  const auto lowest = std::max(0.0, here - static_cast<double>(down_));
  const auto highest = std::max(1.0, here + static_cast<double>(up_));
  const auto stands = begin_w_ <= static_cast<double>(down_) * level_m2ps2;
  const auto way_m = static_cast<double>(first_) * step_m - begin_m_;
  for (auto l = static_cast<std::size_t>(std::ceil(lowest));
       l <= top_[first_] && static_cast<double>(l) <= highest; ++l)
    if (begin_mps_ + speeds_[l] > 0.5) {
      const auto takes_s = begin_s_ + 2 * way_m / (begin_mps_ + speeds_[l])
                           + (begin_mps_ < 0.5 ? set_off_s : 0);
      take(no, first_, l, takes_s, takes_s);
      if (l == 0 || (stands && l <= up_))
        take(yes, first_, l, takes_s, infinity);
    }
  for (auto k = first_ + 1; k < count; ++k)
    for (std::size_t l = 0; l <= top_[k]; ++l) {
      state reached[2] = {{1e9, -1e9}, {1e9, -1e9}};
      const auto first = l > up_ ? l - up_ : 0;
      const auto last = std::min(top_[k - 1], l + down_);
      for (auto q = std::max<std::size_t>(first, l == 0); q <= last; ++q) {
        const auto takes_s = static_cast<float>(
            2 * step_m / (speeds_[q] + speeds_[l]) + (q == 0 ? set_off_s : 0));
        for (const auto how : {no, yes}) {
          const auto& x = at(how, k - 1, q);
          if (x.from_s > x.to_s)
            continue;
          reached[how].from_s = std::min(reached[how].from_s, x.from_s + takes_s);
          reached[how].to_s = std::max(reached[how].to_s, x.to_s + takes_s);
        }
      }
      if (l == 0) { // it stands there as long as it likes
        reached[yes].from_s = std::min(reached[no].from_s, reached[yes].from_s);
        if (reached[yes].from_s < 1e8)
          reached[yes].to_s = static_cast<float>(infinity);
        reached[no] = {1, 0};
      }
      for (const auto how : {no, yes})
        if (reached[how].from_s <= reached[how].to_s)
          take(how, k, l, reached[how].from_s, reached[how].to_s);
    }
}

bool window_drive::read_back(const task& what, way_motion& out) {
  const auto count = what.earliest_s.size();
  auto level = levels;
  auto how = no;
  double t = infinity;
  for (std::size_t l = 0; l <= top_[count - 1]; ++l)
    for (const auto h : {no, yes}) {
      const auto& x = at(h, count - 1, l);
      if (x.from_s <= x.to_s && x.from_s <= t + 1e-4) {
        level = l;
        how = h;
        t = x.from_s;
      }
    }
  if (level == levels)
    return false;
  // Every half step; where it stands, it is there first and goes later.
  std::vector<double> times_s(parts * (count - 1) + 1);
  auto left_s = t;
  double worst_miss_s = 0;
  for (auto k = count - 1;; --k) {
    times_s[parts * k] = t;
    if (k == first_) {
      const auto way_m = static_cast<double>(first_) * step_m - begin_m_;
      const auto goes_s = left_s - 2 * way_m / (begin_mps_ + speeds_[level]);
      for (std::size_t i = 0; i < parts * k; ++i) {
        const auto at_m = 0.5 * static_cast<double>(i);
        times_s[i] = i == 0 ? 0
                     : i <= prefix_.size() ? prefix_[i - 1]
                     : std::lerp(goes_s, left_s, (at_m - begin_m_) / way_m);
      }
      break;
    }
    const auto wait = what.s_m + static_cast<double>(k) * step_m < what.line_m;
    const auto first = std::max<std::size_t>(level > up_ ? level - up_ : 0,
                                             level == 0);
    const auto last = std::min(top_[k - 1], level + down_);
    auto best = levels;
    auto best_how = how;
    auto miss_s = infinity;
    for (auto n = first; n <= last; ++n) {
      const auto q = wait ? n : first + last - n;
      for (const auto h : {no, yes}) {
        const auto& x = at(h, k - 1, q);
        if ((h != how && level > 0) || x.from_s > x.to_s)
          continue;
        const auto then = t - 2 * step_m / (speeds_[q] + speeds_[level])
                          - (q == 0 ? set_off_s : 0);
        const auto off_s = std::max({0.0, x.from_s - then, then - x.to_s});
        if (off_s < miss_s - 1e-3) {
          miss_s = off_s;
          best = q;
          best_how = h;
        }
      }
    }
    if (best == levels)
      return false;
    worst_miss_s = std::max(worst_miss_s, miss_s);
    const auto takes_s = 2 * step_m / (speeds_[best] + speeds_[level])
                         + (best == 0 ? set_off_s : 0);
    left_s = t - takes_s;
    for (std::size_t i = 1; i < parts; ++i) {
      const auto share = static_cast<double>(i) / static_cast<double>(parts);
      const auto v = std::sqrt(std::lerp(speeds_[best] * speeds_[best],
                                         speeds_[level] * speeds_[level], share));
      times_s[parts * (k - 1) + i] = left_s + (best == 0 ? set_off_s : 0)
                                     + 2 * share * step_m / (speeds_[best] + v);
    }
    level = best;
    how = best_how;
    t = level == 0 ? std::min<double>(left_s, at(yes, k - 1, 0).from_s) : left_s;
  }
  for (std::size_t i = 1; i < times_s.size(); ++i)
    times_s[i] = std::max(times_s[i], times_s[i - 1]);
  if (std::getenv("WHY") && worst_miss_s > .1) std::printf("miss %.2f v %.2f\n", worst_miss_s, what.speed_mps);
  if (worst_miss_s > 1) return false;
  out = way_motion{what.s_m, std::move(times_s)};
  return true;
}

} // namespace sofof::planners
