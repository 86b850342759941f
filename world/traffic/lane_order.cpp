// Who drives ahead of whom: the road users of every lane in order.
#include "world/traffic/lane_order.hpp"

#include <algorithm>
#include <ranges>

namespace sofof::world {

/// Looks for the nearest rear bumper of somebody whose axle is ahead of
/// `after_m`, or level with it and with a lower id than `station`.
struct lane_order::gaze {
  const road_user_state& self;
  double after_m;
  station_id station;
  std::optional<road_user_ahead> nearest;

  bool is_ahead(double ahead_m, station_id other) const {
    return ahead_m > 0 || (ahead_m == 0 && other < station);
  }

  /// @returns the first in a lane, which begins at `start_m` for us.
  auto first_ahead(const std::vector<occupant>& lane, double start_m) const {
    return std::ranges::partition_point(lane, [&](const occupant& o) {
      return !is_ahead(o.s_m - (after_m - start_m), o.station);
    });
  }

  void consider(const occupant& o, double axle_m, unrolled_route::leg own,
                double at_least_m = -1e300) {
    const auto rear_m = std::max(axle_m - o.rear_m, at_least_m);
    const auto is_own_tail = o.station == self.known.station; // a lap ahead
    if (!is_own_tail && (!nearest || rear_m < nearest->rear_m))
      nearest = {o.who, axle_m, rear_m, own, o.leg};
  }
};

lane_order::lane_order(const conflict_sides& all)
    : all_{all}, lanes_(all.size()) {}

void lane_order::sort(std::span<const road_user_state> drivers) {
  drivers_ = drivers;
  for (auto& l : lanes_)
    l.clear();
  for (std::uint32_t who = 0; who < drivers.size(); ++who) {
    const auto& d = drivers[who];
    const auto& way = *d.way;
    const auto enter = [&](unrolled_route::leg i) {
      lanes_[way.lane(i)].push_back({d.known.s_m - way.start_m(i),
                                     way.start_m(i + 1) - d.known.s_m,
                                     d.known.rear_m, d.known.station, who, i});
    };
    enter(d.leg);
    for (auto i = d.leg; way.has(i - 1) && way.start_m(i) > d.rear_m(); --i)
      enter(i - 1);
    for (auto i = d.leg + 1; way.has(i) && way.start_m(i) < d.front_m(); ++i)
      enter(i);
  }
  for (auto& l : lanes_)
    std::ranges::sort(l, [](const occupant& a, const occupant& b) {
      return a.s_m < b.s_m || (a.s_m == b.s_m && a.station > b.station);
    });
}

std::optional<road_user_ahead> lane_order::ahead_of(std::size_t i) const {
  const auto& d = drivers_[i];
  return find({d, d.known.s_m, d.known.station, {}});
}

std::optional<road_user_ahead>
lane_order::beyond(std::size_t i, const road_user_ahead& seen) const {
  return find({drivers_[i], seen.axle_m, drivers_[seen.who].known.station, {}});
}

std::optional<road_user_ahead> lane_order::find(gaze from) const {
  const auto& way = *from.self.way;
  const auto end_m = from.self.front_m() + sight_m;
  for (auto i = from.self.leg; way.has(i); ++i) {
    if (way.start_m(i) > (from.nearest ? from.nearest->axle_m : end_m))
      break;
    look_along(from, i);
    for (const auto& e : all_[way.lane(i)])
      if (e.how == conflict::kind::diverge)
        look_at_forking(from, i, e);
      else if (e.how == conflict::kind::merge)
        look_at_joining(from, i, e);
  }
  return from.nearest && from.nearest->rear_m <= end_m ? from.nearest
                                                       : std::nullopt;
}

void lane_order::look_along(gaze& from, unrolled_route::leg i) const {
  const auto start_m = from.self.way->start_m(i);
  const auto& lane = lanes_[from.self.way->lane(i)];
  const auto o = from.first_ahead(lane, start_m);
  if (o != lane.end())
    from.consider(*o, start_m + o->s_m, i);
}

void lane_order::look_at_forking(gaze& from, unrolled_route::leg i,
                                 const conflict_side& e) const {
  const auto start_m = from.self.way->start_m(i);
  if (from.self.rear_m() >= start_m + e.to_m)
    return;
  const auto& lane = lanes_[e.other_lane];
  auto o = from.first_ahead(lane, start_m);
  while (o != lane.end() && o->s_m < 0)
    ++o; // still where all come from, not on the other lane
  if (o != lane.end() && o->s_m - o->rear_m < e.other_to_m)
    from.consider(*o, start_m + o->s_m, i);
}

void lane_order::look_at_joining(gaze& from, unrolled_route::leg i,
                                 const conflict_side& e) const {
  const auto& way = *from.self.way;
  const auto end_m = way.start_m(i + 1);
  for (const auto& o : lanes_[e.other_lane] | std::views::reverse) {
    const auto& other = drivers_[o.who];
    if (o.s_m + other.known.front_m <= e.other_from_m
        || !from.is_ahead((end_m - from.after_m) - o.to_end_m, o.station))
      break;
    if (o.to_end_m < 0 || !way.has(i + 1) || !other.way->has(o.leg + 1)
        || way.lane(i + 1) != other.way->lane(o.leg + 1))
      continue;
    // Who waits for the zone has all of it ahead, not a part of a body.
    const auto zone_m = way.start_m(i) + e.from_m;
    from.consider(o, end_m - o.to_end_m, i,
                  from.self.front_m() < zone_m ? zone_m : -1e300);
  }
}

double lane_order::shared_to_m(std::size_t i, const road_user_ahead& seen,
                               double limit_m) const {
  const auto &own = *drivers_[i].way, &its = *drivers_[seen.who].way;
  for (auto a = seen.own_leg, b = seen.its_leg;; ++a, ++b) {
    if (own.start_m(a) >= limit_m || !own.has(a) || !its.has(b))
      return limit_m;
    if (own.lane(a) == its.lane(b))
      continue;
    const auto& list = all_[own.lane(a)];
    const auto e =
        std::ranges::find(list, its.lane(b), &conflict_side::other_lane);
    if (e == list.end() || e->how == conflict::kind::crossing)
      return std::min(limit_m, own.start_m(a));
    if (e->how == conflict::kind::diverge)
      return std::min(limit_m,
                      own.start_m(a) + std::max(e->to_m, e->other_to_m));
  }
}

} // namespace sofof::world
