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

/// @returns whether two bodies could touch within the limit, whichever way
/// they went.
bool are_near(const road_body& a, const road_body& b) {
  const auto reach_m =
      half_diagonal_m(a.box) + half_diagonal_m(b.box)
      + near_miss_s * (std::abs(a.speed_mps) + std::abs(b.speed_mps));
  const auto apart = b.box.centre - a.box.centre;
  return dot(apart, apart) <= reach_m * reach_m;
}

} // namespace

// Seen from one of them, the other moves straight. On each axis of a side their
// shadows overlap from one time to another; they touch while all of them do.
std::optional<double> time_to_collision_s(const road_body& a,
                                          const road_body& b) {
  const auto of_a = axes_of(a.box), of_b = axes_of(b.box);
  const auto apart = b.box.centre - a.box.centre;
  const auto moves = b.speed_mps * of_b.along + -a.speed_mps * of_a.along;
  auto from_s = 0.0, to_s = std::numeric_limits<double>::infinity();
  for (const auto axis : {of_a.along, of_a.left, of_b.along, of_b.left}) {
    const auto room_m = reach_m(a.box, of_a, axis) + reach_m(b.box, of_b, axis);
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

std::span<const near_miss>
near_miss_watch::look(std::span<const road_body> bodies, time_point now) {
  begun_.clear();
  std::erase_if(open_, [now](const encounter& e) {
    return now - e.last > same_encounter;
  });
  from_west_.clear();
  for (const auto& body : bodies) {
    const auto reach_m =
        half_diagonal_m(body.box) + near_miss_s * std::abs(body.speed_mps);
    const auto x_m = body.box.centre.x_m;
    from_west_.push_back({x_m - reach_m, x_m + reach_m, &body});
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

void near_miss_watch::meet(const road_body& a, const road_body& b,
                           time_point now) {
  const auto left_s = time_to_collision_s(a, b);
  if (!left_s || *left_s >= near_miss_s)
    return;
  const auto first = std::min(a.id, b.id), second = std::max(a.id, b.id);
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
