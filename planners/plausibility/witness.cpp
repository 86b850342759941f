// Somebody who looks at the road and tells what is there.
#include "planners/plausibility/witness.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace sofof::planners {

namespace {

using namespace std::chrono_literals;

/// After so long a body that is still seen has been told of again: T_GenCpmMax
/// and a CPM's period. Source: TS 103 324 V2.1.1, section 6.1.2.
constexpr duration due_again = 1250ms;

/// From the first sight of a body to the message that tells of it, and more.
constexpr duration noticed_after = 300ms;

/// A body is in the place of another if their middles are no farther apart,
/// along it and across; cars side by side are.
constexpr auto along_m = 2.0;
constexpr auto across_m = 1.5;

/// Well within range and field of view is so far from their limits.
constexpr auto range_margin_m = 4.0;
constexpr auto field_margin_rad = 0.1;

/// Round a body that is to be open, and round those that may hide it.
constexpr auto margin_m = 1.0;
constexpr auto screen_margin_m = 0.5;

/// A part of a body that sensors see whole.
constexpr auto part_m = 4.0;

/// Whoever passes through the place of another does so faster.
constexpr auto alike_mps = 2.5;

/// A body that is known rarely moves steadily: messages tell when it does not.
constexpr auto most_off_m = 1.0;

/// Of a road user, usually.
constexpr auto accel_mps2 = 4.0;

/// By how much a road user may be off after `t_s` at constant speed, m.
double drift_m(double t_s) {
  return 0.5 * accel_mps2 * t_s * t_s;
}

point velocity_of(const world::perceived_object& x) {
  return x.speed_mps * point{std::cos(x.heading_rad), std::sin(x.heading_rad)};
}

world::perceived_object body_at(const track& x, time_point t) {
  return moved_on(
      {x.centre(), x.heading_rad, x.speed_mps(), 0, x.length_m, x.width_m},
      to_seconds(t - x.at));
}

bool is_in_place(const world::perceived_object& x,
                 const world::perceived_object& other, double off_m) {
  const point ahead{std::cos(x.heading_rad), std::sin(x.heading_rad)};
  const auto apart = other.centre - x.centre;
  return std::abs(dot(ahead, apart)) <= along_m + off_m
         && std::abs(cross(ahead, apart)) <= across_m + 0.3 * off_m;
}

double age_s(time_point then, time_point now) {
  return std::abs(to_seconds(now - then));
}

} // namespace

void witness::look(const road_look& l) {
  assert(!l.ids || l.ids->size() == l.seen.size());
  at_ = l.at;
  seen_at_ = l.seen_at;
  const auto before = from_;
  from_ = l.from;
  if (from_.range_m == 0) {
    from_.range_m = before.range_m;
    from_.field_of_view_deg = before.field_of_view_deg;
  }
  speed_mps_ = l.speed_mps;
  std::erase_if(told_, [&](const told_body& x) {
    return !l.ids || at_ - x.is.at > due_again
           || std::ranges::find(*l.ids, x.id) != l.ids->end();
  });
  for (std::size_t i = 0; i < l.seen.size(); ++i)
    told_.push_back({l.ids ? (*l.ids)[i] : 0, {l.seen_at, l.seen[i]}});
  assert(told_.size() >= l.seen.size());
  is_complete_ = told_.size() >= l.in_sight;
}

bool witness::stands_in(const track& x) const {
  return distance_m(body_at(x, at_).centre, from_.at) < x.width_m;
}

witness::sight witness::look_at(const track& x) const {
  const auto known_s = age_s(x.seen, at_);
  const auto here = body_at(x, at_);
  auto found = sight::nothing;
  for (const auto& b : told_) {
    const auto told_s = age_s(b.is.at, at_);
    assert(told_s >= 0 && known_s >= 0);
    const auto there = moved_on(b.is.what, told_s);
    if (!is_in_place(here, there, drift_m(known_s) + drift_m(told_s)))
      continue;
    const auto apart = velocity_of(there) - velocity_of(here);
    const auto limit_mps = alike_mps + accel_mps2 * told_s;
    if (is_in_place(here, there, std::min(drift_m(told_s), most_off_m))
        && dot(apart, apart) <= limit_mps * limit_mps)
      return sight::same;
    found = sight::another;
  }
  return found;
}

bool witness::overlooks(const track& x, const line_of_sight& houses) const {
  return overlooks(timed_body{at_, body_at(x, at_)}, houses);
}

bool witness::overlooks(const timed_body& x,
                        const line_of_sight& houses) const {
  const auto before = at_ - noticed_after;
  const auto at = [&x](time_point t) {
    return moved_on(x.what, to_seconds(t - x.at));
  };
  return is_complete_ && is_open(at(at_), houses, at_)
         && is_open(at(before), houses, before);
}

bool witness::is_sure(const line_of_sight& houses) const {
  return std::ranges::all_of(told_, [&](const told_body& b) {
    const auto now = moved_on(b.is.what, to_seconds(at_ - b.is.at));
    return b.is.at == seen_at_ || is_open(now, houses, at_, &b);
  });
}

bool witness::overlooked(const track& x, const line_of_sight& houses) const {
  const auto since_s = to_seconds(x.at - at_);
  if (since_s < 0 || since_s > to_seconds(due_again) || !is_sure(houses)
      || look_at(x) != sight::nothing)
    return false;
  const auto off_m = drift_m(since_s);
  assert(off_m >= 0 && since_s <= to_seconds(due_again));
  const Eigen::Vector2d ahead{std::cos(x.heading_rad), std::sin(x.heading_rad)};
  return std::ranges::all_of(std::array{-off_m, 0.0, off_m}, [&](double by_m) {
    auto moved = x;
    moved.rest.reset();
    moved.motion.mean.col(0) += by_m * ahead;
    return overlooks(moved, houses);
  });
}

bool witness::would_see(const track& x, const line_of_sight& houses,
                        time_point now) const {
  return is_complete_ && now - at_ <= due_again
         && is_open(body_at(x, now), houses, now);
}

bool witness::is_open(const world::perceived_object& body,
                      const line_of_sight& houses, time_point t,
                      const told_body* self) const {
  const point ahead{std::cos(from_.heading_rad), std::sin(from_.heading_rad)};
  const auto eye = from_.at + speed_mps_ * to_seconds(t - at_) * ahead;
  const auto view = body.centre - eye;
  const auto far_m = std::sqrt(dot(view, view));
  if (far_m > from_.range_m - range_margin_m)
    return false;
  if (from_.field_of_view_deg < 360) {
    const auto off_rad =
        std::abs(std::atan2(cross(ahead, view), dot(ahead, view)));
    const auto near_rad = std::atan2(2 * margin_m, far_m);
    if (off_rad > from_.field_of_view_deg / 2 * std::numbers::pi / 180
                      - field_margin_rad - near_rad)
      return false;
  }
  const auto is_free = [&](point p) {
    return houses.is_free(eye, p)
           && std::ranges::none_of(told_, [&](const told_body& b) {
                if (&b == self)
                  return false;
                const auto s = to_seconds(t - b.is.at);
                const auto screen = moved_on(b.is.what, s);
                const auto grown_m =
                    2 * (screen_margin_m + drift_m(std::abs(s)));
                return crosses(eye, p,
                               {screen.centre, screen.heading_rad,
                                screen.length_m + grown_m,
                                screen.width_m + grown_m});
              });
  };
  const point along{std::cos(body.heading_rad), std::sin(body.heading_rad)};
  const point left{-along.y_m, along.x_m};
  const auto half_m = std::min(body.length_m, part_m) / 2 + margin_m;
  const auto side_m = std::min(body.width_m, part_m) / 2 + margin_m;
  assert(half_m >= margin_m && side_m >= margin_m);
  const auto is_part_free = [&](double at_m) {
    const auto middle = body.centre + at_m * along;
    return is_free(middle) && is_free(middle + half_m * along + side_m * left)
           && is_free(middle + half_m * along - side_m * left)
           && is_free(middle - half_m * along + side_m * left)
           && is_free(middle - half_m * along - side_m * left);
  };
  const auto end_m = (body.length_m - part_m) / 2;
  return is_part_free(0)
         || (end_m > part_m / 2
             && (is_part_free(end_m) || is_part_free(-end_m)));
}

} // namespace sofof::planners
