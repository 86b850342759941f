// Listing orders and sides.
#include "planners/trajectory/maneuver_candidates.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// Between those who cross and the own car, at the place that both use.
constexpr double gap_after_s = 0.8;
/// Whoever goes first shall not notice that the own car went before.
constexpr double gap_before_s = 1.5;
/// When a way is made at the soonest.
double soonest_s(double way_m, const crossing_car& car) {
  const auto v = car.speed_mps, a = car.max_accel_mps2;
  const auto top = std::max(v, car.top_mps);
  assert(v >= 0 && a > 0);
  const auto until_top = (top * top - v * v) / (2 * a);
  if (way_m < until_top)
    return (std::sqrt(v * v + 2 * a * way_m) - v) / a;
  return (top - v) / a + (way_m - until_top) / top;
}

void put_first(auto& orders, std::uint32_t choice) {
  const auto it =
      std::ranges::find(orders, choice, [](const auto& x) { return x.choice; });
  if (it != orders.end())
    std::rotate(orders.begin(), it, it + 1);
}

} // namespace

void list_orders(std::span<const crossing_user> users, const crossing_car& car,
                 const std::function<double(double)>& way, std::uint32_t first,
                 std::size_t most, std::vector<crossing_order>& out) {
  assert(most >= 1 && car.max_accel_mps2 > 0);
  assert(car.speed_mps >= 0 && way);
  struct place {
    double line_m, clear_m; // way to before and behind the crossing
    const crossing_user* user;
  };
  std::array<place, crossing_order::most_users> minded;
  std::size_t n = 0;
  for (const auto& user : users) {
    const auto line = way(user.from_m - car.front_m);
    const auto waits_for = user.goes_first || user.enter_s <= 0;
    if (waits_for && line >= 0 && n < minded.size())
      minded[n++] = {line, way(user.to_m + car.rear_m), &user};
  }
  out.clear();
  for (std::uint32_t choice = 0; choice < (1U << n); ++choice) {
    crossing_order order;
    order.choice = choice;
    auto possible = true;
    for (std::size_t i = 0; i < n; ++i) {
      const auto& [line, clear, user] = minded[i];
      auto& window = order.windows[order.count++];
      if ((choice >> i & 1U) != 0) {
        window = {clear, -speed_constraints::never,
                  user->enter_s - gap_before_s};
        possible &= soonest_s(clear, car) <= window.latest_s;
      } else {
        window = {line, user->leave_s + gap_after_s, speed_constraints::never};
        possible &= std::isfinite(window.earliest_s);
      }
    }
    if (possible)
      out.push_back(order);
  }
  put_first(out, first);
  if (out.size() > most)
    out.resize(std::max<std::size_t>(most, 1));
  if (n == 0) {
    assert(out.size() == 1 && out.front().count == 0);
    return;
  }
  crossing_order order;
  order.choice = crossing_order::waits;
  for (std::size_t i = 0; i < n; ++i)
    order.stop_m = std::min(order.stop_m, minded[i].line_m);
  assert(order.stop_m >= 0); // before the first crossing, and not behind
  out.push_back(order);
  put_first(out, first);
}

bool leaves_room(const lane_obstacle& body, side_of_road side,
                 double half_width_m) {
  const auto room = side == side_of_road::right ? body.low_m + half_width_m
                                                : half_width_m - body.high_m;
  return room >= corridor::room_beside_m;
}

void list_sides(std::span<const lane_obstacle> bodies, double half_width_m,
                std::uint32_t first, std::size_t most,
                std::vector<passing_order>& out) {
  assert(most >= 1 && !(half_width_m < 0));
  const auto n = std::min(bodies.size(), most_bodies);
  const auto side_in = [](std::uint32_t choice, std::size_t i) {
    return (choice >> i & 1U) != 0 ? side_of_road::right : side_of_road::left;
  };
  std::size_t used = 0;
  for (std::uint32_t choice = 0; choice < (1U << n); ++choice) {
    auto possible = true;
    for (std::size_t i = 0; i < n; ++i)
      possible &= leaves_room(bodies[i], side_in(choice, i), half_width_m);
    if (!possible)
      continue;
    if (used == out.size())
      out.emplace_back();
    assert(used < out.size());
    auto& order = out[used++];
    order.choice = choice;
    order.bodies.clear();
    for (std::size_t i = 0; i < n; ++i)
      order.bodies.push_back({bodies[i], side_in(choice, i)});
  }
  out.resize(used);
  assert(n > 0 || used == 1); // nothing can be passed in one way
  put_first(out, first);
  if (out.size() > most)
    out.resize(std::max<std::size_t>(most, 1));
}

} // namespace sofof::planners
