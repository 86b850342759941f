// Where routes go through the crossings of an area.
#include "planners/crossing/crossing_ways.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// Bodies are kept so much wider and longer off each other, m.
constexpr double beside_m = 0.3;

/// A place shortly before and behind a crossing tells its lanes, m.
constexpr double near_m = 2;

/// So near to it, ways may still part and join, m.
constexpr double one_lane_m = 30;

} // namespace

crossing_ways::crossing_ways(std::shared_ptr<const lane_network> lanes,
                             area within, const world::vehicle_params& car)
    : lanes_{std::move(lanes)}, within_{within}, car_{car} {
  assert(lanes_ && within.radius_m > 0);
}

const crossing_ways::known_route&
crossing_ways::know(const route_profile_ptr& way) {
  assert(way);
  auto& route = routes_[way->line.way().name()];
  if (route.way != way) {
    route.way = way;
    list_ways(route);
  }
  assert(std::ranges::is_sorted(
      route.ways, {}, [&](std::size_t i) { return ways_[i].enters_m; }));
  return route;
}

/// Ways that part shortly before a crossing come on one lane, those that join
/// shortly behind it go on on one.
void crossing_ways::find_lanes(const world::route& route,
                               crossing_way& x) const {
  const auto lanes = route.sequence();
  assert(!lanes.empty() && x.leaves_m >= x.enters_m);
  const auto index_at = [&](double s_m) {
    std::size_t i = 0;
    while (i + 1 < lanes.size() && route.start_of_m(i + 1) <= s_m)
      ++i;
    return i;
  };
  auto in = index_at(std::max(0.0, x.enters_m - near_m));
  for (auto i = in; i > 0 && route.start_of_m(i) > x.enters_m - one_lane_m;)
    if (lanes_->next(lanes[--i]).size() > 1)
      in = i;
  assert(in < lanes.size());
  x.lane = lanes[in];
  x.lane_ends_m = route.start_of_m(in + 1);
  auto out = index_at(x.leaves_m + near_m);
  for (auto i = out; i + 1 < lanes.size()
                     && route.start_of_m(i + 1) < x.leaves_m + one_lane_m;)
    if (lanes_->previous(lanes[++i]).size() > 1)
      out = i;
  assert(in < lanes.size() && out < lanes.size());
  x.out_lane = lanes[out];
}

void crossing_ways::list_ways(known_route& route) {
  assert(route.way);
  route.ways.clear();
  const auto& line = route.way->line.way();
  const auto half_m = (car_.front_m + car_.rear_m) / 2;
  // An alias: who owns it lives in the profile.
  const world::unrolled_route way{world::route_ptr{route.way, &line},
                                  lanes_->meetings()};
  struct stretch {
    double from_m, to_m;
    std::optional<std::size_t> ring; // on which it ends
    bool is_round;
  };
  std::optional<stretch> one;
  const auto add = [&] {
    assert(one->to_m >= one->from_m);
    crossing_way x{route.way, one->from_m - half_m, one->to_m + half_m};
    x.is_round = one->is_round;
    find_lanes(line, x);
    route.ways.push_back(ways_.size());
    ways_.push_back(std::move(x));
  };
  way.for_zones(0, line.length_m(), [&](const world::zone& z) {
    assert(z.to_m >= z.from_m);
    const auto middle = line.path().at((z.from_m + z.to_m) / 2).at;
    if (distance_m(middle, within_.centre) > within_.radius_m)
      return true;
    const auto own = lanes_->roundabout(z.side);
    const auto ring = own ? own : lanes_->roundabout(z.other_side());
    if (one && z.from_m > one->to_m + one_crossing_m
        && !(ring && ring == one->ring)) {
      add();
      one.reset();
    }
    if (!one)
      one = {z.from_m, z.from_m, ring, false};
    one->to_m = std::max(one->to_m, z.to_m);
    one->ring = ring;
    one->is_round = one->is_round || ring;
    return true;
  });
  assert(half_m > 0);
  if (one)
    add();
}

std::optional<crossing_ways::place>
crossing_ways::find(const route_profile_ptr& way, double s_m, double ahead_m) {
  assert(std::isfinite(s_m) && ahead_m > 0);
  assert(way);
  const auto& route = know(way);
  const auto lap_m = way->line.way().length_m();
  const auto laps =
      way->line.way().closed() ? std::floor(s_m / lap_m) * lap_m : 0.0;
  const auto here_m = s_m - laps + middle_m();
  for (const auto next_lap_m : {0.0, lap_m}) {
    for (const auto i : route.ways)
      if (const auto& x = ways_[i]; x.leaves_m + next_lap_m > here_m) {
        if (x.enters_m + next_lap_m > here_m + ahead_m)
          return std::nullopt;
        return place{i, here_m - next_lap_m, laps + next_lap_m};
      }
    if (!way->line.way().closed())
      break;
  }
  return std::nullopt;
}

const world::meeting_curve& crossing_ways::meet(std::size_t first,
                                                std::size_t then) {
  assert(first < ways_.size() && then < ways_.size());
  assert(ways_[first].way && ways_[then].way);
  const auto [known, is_new] = meet_.try_emplace({first, then});
  if (is_new) {
    const world::moving_body body{car_.front_m + car_.rear_m + beside_m,
                                  car_.width_m + beside_m};
    const auto stretch = [&](const crossing_way& x) {
      const auto& line = x.way->line.way();
      const auto from_m = x.enters_m - before_m, to_m = x.leaves_m + behind_m;
      return line.closed()
                 ? world::path_stretch{&line.path(), from_m, to_m}
                 : world::path_stretch{&line.path(), std::max(0.0, from_m),
                                       std::min(line.length_m(), to_m)};
    };
    known->second = {stretch(ways_[first]), body, stretch(ways_[then]), body};
  }
  return known->second;
}

} // namespace sofof::planners
