// Who has nearly hit whom: a measure of safety where nobody collides.
#include "world/traffic/near_miss.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sofof::world {

namespace {

struct axes {
  point along, left;
};

axes axes_of(const oriented_box& box) {
  const auto c = std::cos(box.heading_rad), s = std::sin(box.heading_rad);
  return {{c, s}, {-s, c}};
}

/// @returns how far a box reaches from its centre in a direction.
double reach_m(const oriented_box& box, const axes& own, point direction) {
  return box.length_m / 2 * std::abs(dot(own.along, direction))
         + box.width_m / 2 * std::abs(dot(own.left, direction));
}

double half_diagonal_m(const oriented_box& box) {
  return 0.5 * std::hypot(box.length_m, box.width_m);
}

/// How far somebody can be off his lane's way: the middle of a body sweeps
/// wider than its rear axle, and its speed is the axle's.
constexpr double sweep_factor = 1.25;

double reach_in_time_m(const road_user& x) {
  return half_diagonal_m(x.body)
         + sweep_factor * near_miss_s * std::abs(x.speed_mps);
}

/// @returns whether two bodies could touch within the limit, whichever way
/// they went.
bool are_near(const road_user& a, const road_user& b) {
  const auto reach_m = reach_in_time_m(a) + reach_in_time_m(b);
  const auto apart = b.body.centre - a.body.centre;
  return dot(apart, apart) <= reach_m * reach_m;
}

// Seen from one of them, the other moves straight. On each axis of a side their
// shadows overlap from one time to another; they touch while all of them do.
/// @param moves  Of b, seen from a, m/s.
std::optional<double> first_touch_s(const oriented_box& a,
                                    const oriented_box& b, point moves) {
  const auto of_a = axes_of(a), of_b = axes_of(b);
  const auto apart = b.centre - a.centre;
  auto from_s = 0.0, to_s = std::numeric_limits<double>::infinity();
  for (const auto axis : {of_a.along, of_a.left, of_b.along, of_b.left}) {
    const auto room_m = reach_m(a, of_a, axis) + reach_m(b, of_b, axis);
    const auto apart_m = dot(apart, axis), mps = dot(moves, axis);
    if (mps == 0) {
      if (std::abs(apart_m) > room_m)
        return std::nullopt;
      continue;
    }
    const auto middle_s = -apart_m / mps, half_s = room_m / std::abs(mps);
    from_s = std::max(from_s, middle_s - half_s);
    to_s = std::min(to_s, middle_s + half_s);
  }
  return from_s <= to_s ? std::optional{from_s} : std::nullopt;
}

/// Where a road user will be if it goes on along its route as now: its rear
/// axle keeps its speed along the lane and across it, its body its angle to it.
class lane_motion {
public:
  explicit lane_motion(const road_user& x)
      : x_{x}, to_middle_m_{(x.front_m - x.rear_m) / 2} {
    const auto lane = place_at(x.s_m);
    const auto axle = x.body.centre - to_middle_m_ * axes_of(x.body).along;
    const auto off = axle - lane.at;
    off_m_ = {dot(lane.tangent, off), cross(lane.tangent, off)};
    off_rad_ = x.body.heading_rad - lane.heading_rad;
    along_mps_ = x.speed_mps * std::cos(off_rad_);
    across_mps_ = x.speed_mps * std::sin(off_rad_);
  }

  oriented_box after(double t_s) const {
    const auto lane = place_at(x_.s_m + along_mps_ * t_s);
    const point left{-lane.tangent.y_m, lane.tangent.x_m};
    auto box = x_.body;
    box.heading_rad = lane.heading_rad + off_rad_;
    box.centre = lane.at + off_m_.x_m * lane.tangent
                 + (off_m_.y_m + across_mps_ * t_s) * left
                 + to_middle_m_ * axes_of(box).along;
    return box;
  }

private:
  /// The path, and straight on beyond an end of it.
  path_frame place_at(double s_m) const {
    const auto& path = x_.on->path();
    auto found = path.frame(s_m);
    if (!path.closed()) {
      const auto beyond_m = s_m - std::clamp(s_m, 0.0, path.length_m());
      found.at = found.at + beyond_m * found.tangent;
    }
    return found;
  }

  const road_user& x_;
  double to_middle_m_;
  point off_m_; // along and across
  double off_rad_ = 0;
  double along_mps_ = 0, across_mps_ = 0;
};

} // namespace

std::optional<double> time_to_collision_s(const road_body& a,
                                          const road_body& b) {
  return first_touch_s(a.box, b.box,
                       b.speed_mps * axes_of(b.box).along
                           + -a.speed_mps * axes_of(a.box).along);
}

// In pieces that are as good as straight.
std::optional<double> time_to_collision_s(const road_user& a,
                                          const road_user& b) {
  constexpr auto pieces = 15;
  constexpr auto piece_s = near_miss_s / pieces;
  const lane_motion of_a{a}, of_b{b};
  auto here_a = of_a.after(0), here_b = of_b.after(0);
  for (auto k = 1; k <= pieces; ++k) {
    const auto next_a = of_a.after(k * piece_s),
               next_b = of_b.after(k * piece_s);
    const auto moves =
        1 / piece_s
        * ((next_b.centre - here_b.centre) - (next_a.centre - here_a.centre));
    const auto touch_s = first_touch_s(here_a, here_b, moves);
    if (touch_s && *touch_s <= piece_s)
      return (k - 1) * piece_s + *touch_s;
    here_a = next_a;
    here_b = next_b;
  }
  return std::nullopt;
}

std::span<const near_miss>
near_miss_watch::look(std::span<const road_user> users, time_point now) {
  begun_.clear();
  std::erase_if(open_, [now](const encounter& e) {
    return now - e.last > same_encounter;
  });
  from_west_.clear();
  for (const auto& user : users) {
    const auto reach_m = reach_in_time_m(user);
    const auto x_m = user.body.centre.x_m;
    from_west_.push_back({x_m - reach_m, x_m + reach_m, &user});
  }
  std::ranges::sort(from_west_, {}, &extent::west_m);
  for (auto a = from_west_.begin(); a != from_west_.end(); ++a)
    for (auto b = a + 1; b != from_west_.end() && b->west_m <= a->east_m; ++b)
      if (are_near(*a->who, *b->who))
        meet(*a->who, *b->who, now);
  std::ranges::sort(begun_, {}, [](const near_miss& x) {
    return std::pair{x.first, x.second};
  });
  return begun_;
}

void near_miss_watch::meet(const road_user& a, const road_user& b,
                           time_point now) {
  const auto left_s = time_to_collision_s(a, b);
  if (!left_s || *left_s >= near_miss_s)
    return;
  const auto first = std::min(a.station, b.station),
             second = std::max(a.station, b.station);
  const auto known =
      std::ranges::find_if(open_, [first, second](const encounter& e) {
        return e.first == first && e.second == second;
      });
  if (known != open_.end()) {
    known->last = now;
    return;
  }
  open_.push_back({first, second, now});
  begun_.push_back({first, second, *left_s});
}

} // namespace sofof::world
