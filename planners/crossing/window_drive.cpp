// Reachable times, place by place; then one drive, read backwards.
#include "planners/crossing/window_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::planners {
namespace {

constexpr auto never_s = std::numeric_limits<double>::infinity();

/// Levels of v²/2, to 15.5 m/s.
constexpr double level_m2ps2 = 0.5;
constexpr std::size_t levels = 240;

/// By so much a bounded jerk delays who sets off.
constexpr double sets_off_s = 0.6;
constexpr double fading_mps3 = 1.6;

/// A car that drives closely behind another may have to brake by so many
/// levels more.
constexpr std::size_t harder = 3;

/// A drive may be out by so much where the times between are not reached.
constexpr double drive_exact_s = 1;

constexpr auto parts_in_step =
    static_cast<std::size_t>(window_drive::step_m / way_motion::step_m);

std::size_t levels_in_step(double accel_mps2) {
  return static_cast<std::size_t>(accel_mps2 * window_drive::step_m
                                  / level_m2ps2);
}

std::size_t level_of(double speed_mps) {
  return std::min(
      levels - 1,
      static_cast<std::size_t>(speed_mps * speed_mps / 2 / level_m2ps2 + 1e-9));
}

} // namespace

window_drive::window_drive(const free_drive_limits& limits)
    : up_{levels_in_step(limits.accel_mps2)}, down_{levels_in_step(
                                                  limits.decel_mps2)} {
  assert(up_ > 0 && down_ > 0);
  for (std::size_t l = 0; l < levels; ++l)
    speeds_.push_back(std::sqrt(2 * static_cast<double>(l) * level_m2ps2));
}

bool window_drive::find(const route_profile& way, const task& what,
                        way_motion& out) {
  assert(what.earliest_s.size() >= 2
         && what.earliest_s.size() == what.latest_s.size());
  assert(what.speed_mps >= 0);
  for (const auto more : {std::size_t{0}, harder}) {
    begin(what, more == 0);
    if (first_ + 1 >= what.earliest_s.size())
      continue;
    down_ += more;
    bound(way, what);
    reach(what);
    const auto is_found = read_back(what, out);
    down_ -= more;
    if (is_found)
      return true;
  }
  return false;
}

/// Lets the acceleration fade out.
void window_drive::begin(const task& what, bool smoothly) {
  assert(std::isfinite(what.s_m) && std::isfinite(what.accel_mps2));
  constexpr double dt_s = 0.05, none_mps2 = 0.05;
  fade_s_.clear();
  auto s = 0.0, v = what.speed_mps, t = 0.0, next_m = way_motion::step_m;
  auto a = smoothly ? what.accel_mps2 : 0.0;
  while (std::abs(a) > none_mps2 && v > 0) {
    const auto less = std::min(std::abs(a), fading_mps3 * dt_s);
    const auto a1 = a > 0 ? a - less : a + less;
    const auto v1 = std::max(0.0, v + (a + a1) / 2 * dt_s);
    const auto ds = (v + v1) / 2 * dt_s;
    for (; ds > 0 && s + ds >= next_m; next_m += way_motion::step_m)
      fade_s_.push_back(t + dt_s * (next_m - s) / ds);
    s += ds;
    v = v1;
    a = a1;
    t += dt_s;
  }
  begin_m_ = s;
  begin_mps_ = v;
  begin_s_ = t;
  first_ = static_cast<std::size_t>(s / step_m) + 1;
  assert(begin_s_ >= 0 && first_ >= 1);
}

/// As fast as the way allows; a car that is faster brakes.
void window_drive::bound(const route_profile& way, const task& what) {
  assert(first_ + 1 < what.earliest_s.size());
  const auto count = what.earliest_s.size();
  top_.resize(count);
  for (auto k = count; k-- > 0;) {
    top_[k] = level_of(
        way.envelope.limit_mps(what.s_m + static_cast<double>(k) * step_m));
    if (k + 1 < count)
      top_[k] = std::min(top_[k], top_[k + 1] + down_);
  }
  const auto now = level_of(begin_mps_);
  for (std::size_t k = 0; first_ + k < count && k * down_ <= now; ++k)
    top_[first_ + k] = std::max(top_[first_ + k], now - k * down_);
  assert(std::ranges::all_of(top_, [](auto l) { return l < levels; }));
}

double window_drive::takes_s(std::size_t from_level,
                             std::size_t to_level) const {
  assert(from_level + to_level > 0);
  return 2 * step_m / (speeds_[from_level] + speeds_[to_level])
         + (from_level == 0 ? sets_off_s : 0);
}

void window_drive::reach_at(const task& what, past how, std::size_t place,
                            std::size_t level, double from_s, double to_s) {
  from_s = std::max(from_s, what.earliest_s[place]);
  to_s = std::min(to_s, what.latest_s[place]);
  if (from_s <= to_s)
    at(how, place, level) = {static_cast<float>(from_s),
                             static_cast<float>(to_s)};
}

void window_drive::reach(const task& what) {
  const auto count = what.earliest_s.size();
  for (auto& all : reached_)
    all.assign(count * levels, {});
  reach_first(what);
  for (auto k = first_ + 1; k < count; ++k)
    for (std::size_t l = 0; l <= top_[k]; ++l)
      reach_next(what, k, l);
}

/// From where the grid begins, with the speed there.
void window_drive::reach_first(const task& what) {
  constexpr double hardly_mps = 0.5;
  const auto here = begin_mps_ * begin_mps_ / 2 / level_m2ps2;
  const auto lowest = std::max(0.0, here - static_cast<double>(down_));
  const auto highest = std::max(1.0, here + static_cast<double>(up_));
  assert(lowest <= highest);
  const auto can_stand = here <= static_cast<double>(down_);
  const auto way_m = static_cast<double>(first_) * step_m - begin_m_;
  assert(way_m > 0);
  for (auto l = static_cast<std::size_t>(std::ceil(lowest));
       l <= top_[first_] && static_cast<double>(l) <= highest; ++l) {
    if (begin_mps_ + speeds_[l] < hardly_mps)
      continue;
    const auto t = begin_s_ + 2 * way_m / (begin_mps_ + speeds_[l])
                   + (begin_mps_ < hardly_mps ? sets_off_s : 0);
    reach_at(what, past::rolled, first_, l, t, t);
    if (l == 0 || (can_stand && l <= up_))
      reach_at(what, past::stood, first_, l, t, never_s);
  }
}

void window_drive::reach_next(const task& what, std::size_t place,
                              std::size_t level) {
  assert(place > first_ && level < levels);
  struct {
    double from_s = never_s, to_s = -never_s;
  } all[2];
  const auto last = std::min(top_[place - 1], level + down_);
  for (auto q = level > up_ ? level - up_ : std::size_t{level == 0}; q <= last;
       ++q) {
    const auto step_s = takes_s(q, level);
    for (const auto how : pasts) {
      const auto& x = at(how, place - 1, q);
      if (x.is_empty())
        continue;
      auto& sum = all[static_cast<std::size_t>(how)];
      sum.from_s = std::min(sum.from_s, x.from_s + step_s);
      sum.to_s = std::max(sum.to_s, x.to_s + step_s);
    }
  }
  assert(last < levels);
  auto& [rolled, stood] = all;
  if (level == 0) { // it stands there as long as it likes
    stood.from_s = std::min(rolled.from_s, stood.from_s);
    if (stood.from_s < never_s)
      reach_at(what, past::stood, place, level, stood.from_s, never_s);
    return;
  }
  reach_at(what, past::rolled, place, level, rolled.from_s, rolled.to_s);
  reach_at(what, past::stood, place, level, stood.from_s, stood.to_s);
}

// -- backwards ----------------------------------------------------------------

bool window_drive::find_end(std::size_t place, moment& out) {
  out.t_s = never_s;
  for (std::size_t l = 0; l <= top_[place]; ++l)
    for (const auto how : pasts)
      if (const auto& x = at(how, place, l);
          !x.is_empty() && x.from_s <= out.t_s + 1e-4)
        out = {how, l, x.from_s};
  return out.t_s < never_s;
}

/// @param comes_late  Of several, the slowest before the place is taken.
/// @returns whether there is one before it; its time is when it is left.
bool window_drive::step_back(std::size_t place, bool comes_late,
                             const moment& here, moment& before) {
  const auto first =
      here.level > up_ ? here.level - up_ : std::size_t{here.level == 0};
  const auto last = std::min(top_[place - 1], here.level + down_);
  assert(place > first_ && here.level < levels);
  assert(last < levels);
  auto least_off_s = drive_exact_s;
  auto is_found = false;
  for (auto n = first; n <= last; ++n) {
    const auto q = comes_late ? n : first + last - n;
    for (const auto how : pasts) {
      const auto& x = at(how, place - 1, q);
      if (x.is_empty() || (how != here.how && here.level > 0))
        continue;
      const auto t = here.t_s - takes_s(q, here.level);
      const auto off_s = std::max({0.0, x.from_s - t, t - x.to_s});
      if (off_s < least_off_s - 1e-3) {
        least_off_s = off_s;
        before = {how, q, t};
        is_found = true;
      }
    }
  }
  return is_found;
}

bool window_drive::read_back(const task& what, way_motion& out) {
  const auto count = what.earliest_s.size();
  moment here{};
  if (!find_end(count - 1, here))
    return false;
  assert(std::isfinite(here.t_s));
  times_s_.resize(parts_in_step * (count - 1) + 1);
  for (auto k = count - 1; k > first_; --k) {
    times_s_[parts_in_step * k] = here.t_s;
    const auto comes_late =
        what.s_m + static_cast<double>(k) * step_m < what.line_m;
    moment before{};
    if (!step_back(k, comes_late, here, before))
      return false;
    assert(before.t_s <= here.t_s);
    const auto v0 = speeds_[before.level], v1 = speeds_[here.level];
    for (std::size_t i = 1; i < parts_in_step; ++i) {
      const auto share =
          static_cast<double>(i) / static_cast<double>(parts_in_step);
      const auto v = std::sqrt(std::lerp(v0 * v0, v1 * v1, share));
      times_s_[parts_in_step * (k - 1) + i] =
          before.t_s + (before.level == 0 ? sets_off_s : 0)
          + 2 * share * step_m / (v0 + v);
    }
    here = before;
    if (here.level == 0) // it stands there since it came
      here.t_s = std::min<double>(here.t_s, at(past::stood, k - 1, 0).from_s);
  }
  times_s_[parts_in_step * first_] = here.t_s;
  const auto way_m = static_cast<double>(first_) * step_m - begin_m_;
  const auto last_mps = begin_mps_ + speeds_[here.level];
  write_first(last_mps > 0 ? here.t_s - 2 * way_m / last_mps : here.t_s,
              here.t_s);
  for (std::size_t i = 1; i < times_s_.size(); ++i)
    times_s_[i] = std::max(times_s_[i], times_s_[i - 1]);
  assert(times_s_.size() >= 2);
  out = way_motion{what.s_m, times_s_};
  return true;
}

/// The way to the first place of the grid.
void window_drive::write_first(double goes_s, double left_s) {
  const auto way_m = static_cast<double>(first_) * step_m - begin_m_;
  times_s_[0] = 0;
  for (std::size_t i = 1; i < parts_in_step * first_; ++i) {
    const auto at_m = static_cast<double>(i) * way_motion::step_m;
    times_s_[i] = i <= fade_s_.size()
                      ? fade_s_[i - 1]
                      : std::lerp(goes_s, left_s, (at_m - begin_m_) / way_m);
  }
}

} // namespace sofof::planners
