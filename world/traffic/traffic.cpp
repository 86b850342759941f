// Who is where on the road, who touches whom, and whose turn it is.
#include "world/traffic/traffic.hpp"

#include "world/traffic/lane_order.hpp"
#include "world/traffic/right_of_way.hpp"
#include "world/traffic/road_user_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sofof::world {

namespace {

/// From where to where a body reaches at most.
struct extent {
  double west_m, east_m;
  std::size_t who; // number of the body
};

/// @returns half the diagonal of a box: no corner is farther from its centre.
double radius_m(const oriented_box& box) {
  return 0.5 * std::hypot(box.length_m, box.width_m);
}

bool touch(const oriented_box& a, const oriented_box& b) {
  return distance_m(a.centre, b.centre) <= radius_m(a) + radius_m(b)
         && overlap(a, b);
}

} // namespace

struct traffic::state {
  state(const road_map& map, std::vector<road_body> obstacles,
        bool grants_crossings)
      : all{list_encounters(map)}, grants{grants_crossings}, order{all},
        crossings{map}, standing{std::move(obstacles)} {}

  auto find(station_id station) {
    return std::ranges::lower_bound(drivers, station, {},
                                    &road_user_state::station);
  }

  /// Road users of one route share what is known of it.
  std::shared_ptr<const unrolled_route> find_way(const route_ptr& on) const {
    for (const auto& d : drivers)
      if (d.way->on() == on)
        return d.way;
    return std::make_shared<const unrolled_route>(on, all);
  }

  void grant(time_point now);
  void perceive(time_point now);
  void list_bodies();
  void find_touching();

  const conflict_sides all;
  const bool grants;
  lane_order order;
  right_of_way crossings;
  std::vector<road_user_state> drivers; // in order of station ids
  const std::vector<road_body> standing;
  std::vector<road_body> moving; // by themselves
  std::vector<road_body> bodies; // the drivers', then these
  std::vector<road_user> users;  // the same, as they were reported
  std::vector<extent> from_west;
  std::vector<std::pair<station_id, station_id>> touching;
};

traffic::traffic(const road_map& map, std::vector<road_body> standing,
                 bool grants_crossings)
    : state_{
        std::make_unique<state>(map, std::move(standing), grants_crossings)} {}

traffic::traffic(traffic&&) noexcept = default;
traffic& traffic::operator=(traffic&&) noexcept = default;
traffic::~traffic() = default;

void traffic::report(const road_user& user) {
  auto& drivers = state_->drivers;
  const auto d = state_->find(user.station);
  if (d == drivers.end() || d->station() != user.station)
    drivers.insert(d, road_user_state{user, state_->find_way(user.on)});
  else if (d->known.on == user.on)
    d->known = user;
  else
    *d = road_user_state{user, state_->find_way(user.on)};
}

void traffic::remove(station_id station) {
  const auto d = state_->find(station);
  if (d != state_->drivers.end() && d->station() == station)
    state_->drivers.erase(d);
}

void traffic::place(std::vector<road_body> moving) {
  state_->moving = std::move(moving);
}

void traffic::update(time_point now) {
  if (state_->grants)
    state_->grant(now);
  state_->perceive(now);
  state_->list_bodies();
  state_->find_touching();
}

void traffic::state::grant(time_point now) {
  for (auto& d : drivers)
    d.leg = d.way->leg_at(d.known.s_m);
  order.sort(drivers);
  crossings.decide(drivers, order, now);
}

void traffic::state::perceive(time_point now) {
  for (auto& d : drivers) {
    d.seen = {now, {}, {}};
    if (std::isfinite(d.line_m))
      d.seen.stop_at_m = d.line_m - stop_margin_m;
  }
}

void traffic::state::list_bodies() {
  bodies.clear();
  users.clear();
  for (const auto& d : drivers) {
    bodies.push_back(
        {d.known.station, d.known.body, d.known.speed_mps, d.known.accel_mps2});
    users.push_back(d.known);
  }
  bodies.insert(bodies.end(), standing.begin(), standing.end());
  bodies.insert(bodies.end(), moving.begin(), moving.end());
}

/// Sweeps from west to east: only bodies at the same easting can touch.
void traffic::state::find_touching() {
  touching.clear();
  from_west.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& box = bodies[i].box;
    const auto x_m = box.centre.x_m, r_m = radius_m(box);
    from_west.push_back({x_m - r_m, x_m + r_m, i});
  }
  std::ranges::sort(from_west, {}, &extent::west_m);
  const auto drives = [this](std::size_t i) { return i < drivers.size(); };
  for (auto a = from_west.begin(); a != from_west.end(); ++a)
    for (auto b = a + 1; b != from_west.end() && b->west_m <= a->east_m; ++b) {
      const auto &one = bodies[a->who], &other = bodies[b->who];
      if ((drives(a->who) || drives(b->who)) && touch(one.box, other.box))
        touching.push_back(std::minmax(one.id, other.id));
    }
  std::ranges::sort(touching);
}

perception traffic::perceive(station_id station) const {
  const auto d = state_->find(station);
  if (d == state_->drivers.end() || d->station() != station)
    throw std::out_of_range{
        fmt::format("There is no road user {} in the traffic.", station)};
  return d->seen;
}

std::span<const road_body> traffic::bodies() const {
  return state_->bodies;
}

std::span<const road_user> traffic::users() const {
  return state_->users;
}

std::vector<std::pair<station_id, station_id>> traffic::collisions() const {
  return state_->touching;
}

} // namespace sofof::world
