// The lanes of a map as bodies drive on them.
#include "planners/scene/lane_network.hpp"

#include "world/roads/roundabouts.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <unordered_map>

namespace sofof::planners {

namespace {

constexpr auto piece_m = 2.0, straight_piece_m = 10.0;

/// Outside a bend, whoever is beside the gap between two pieces is beside both.
/// No lane goes on for longer beyond its end.
constexpr auto wedge_m = 0.5;

/// Cosine of the largest angle between a body and its lane, 45°.
constexpr auto same_way = std::numbers::sqrt2 / 2;

/// Nobody drives through a bend, or brakes before it, with more, m/s².
constexpr auto most_lateral_mps2 = 4.0;
constexpr auto most_braking_mps2 = 4.0;
/// A bend begins where it is this share of its sharpest.
constexpr auto share_of_sharpest = 0.7;
constexpr auto least_bend_1pm = 1e-3;

/// So far before a conflict a lane shows where it comes from.
constexpr auto before_m = 15.0;

/// Who stands sets off like this.
constexpr auto sets_off_after_s = 0.5;
constexpr auto sets_off_mps2 = 1.5;

double standing_start_s(double way_m) {
  return sets_off_after_s + std::sqrt(2 * way_m / sets_off_mps2);
}

/// Who is slower may be setting off, m/s.
constexpr auto setting_off_below_mps = 3.0;

/// @returns when a body has come so far: at its speed, or sooner if it is
/// setting off.
double enters_s(double way_m, double speed_mps) {
  const auto v = speed_mps, a = sets_off_mps2;
  return v < setting_off_below_mps ? (std::sqrt(v * v + 2 * a * way_m) - v) / a
                                   : way_m / v;
}

} // namespace

struct lane_network::driver {
  double half_length_m, speed_mps, within_m;
  std::size_t first; // of its arrivals in `out`
  std::vector<conflict_visit>& out;
};

lane_network::lane_network(const world::road_map& map)
    : meetings_{world::list_encounters(map)},
      ranks_(2 * map.conflicts().size()), rounds_(ranks_.size()),
      begins_(ranks_.size()), courses_(ranks_.size()),
      next_(map.lanes().size()), previous_(map.lanes().size()) {
  assert(meetings_.size() == map.lanes().size());
  const world::roundabouts rings{map};
  for (std::size_t lane = 0; lane < meetings_.size(); ++lane)
    for (const auto& e : meetings_[lane]) {
      assert(e.side < ranks_.size() && e.from_m <= e.to_m);
      ranks_[e.side] = e.rank;
      if (const auto ring = rings.of(lane); ring < rings.count())
        rounds_[e.side] = ring;
      begins_[e.side] = {lane, e.from_m};
    }
  std::unordered_map<std::string_view, std::size_t> index;
  for (const auto& l : map.lanes()) {
    index.emplace(l.name, paths_.size());
    half_widths_m_.push_back(l.half_width_m);
    limits_mps_.push_back(
        std::ranges::max(l.limits, {}, &world::speed_zone::limit_mps)
            .limit_mps);
    paths_.emplace_back(l.centre);
    auto sharpest_1pm = least_bend_1pm;
    const auto& path = paths_.back();
    for (auto s_m = 0.0; s_m < path.length_m(); ++s_m)
      sharpest_1pm = std::max(sharpest_1pm, std::abs(path.curvature_1pm(s_m)));
    auto s_m = 0.0;
    while (s_m < path.length_m()
           && std::abs(path.curvature_1pm(s_m))
                  < share_of_sharpest * sharpest_1pm)
      ++s_m;
    bends_.push_back({s_m, std::sqrt(most_lateral_mps2 / sharpest_1pm)});
  }
  cut();
  for (std::size_t i = 0; i < paths_.size(); ++i)
    for (const auto& e : meetings_[i]) {
      const auto from_rad =
          paths_[i].at(std::max(0.0, e.from_m - before_m)).heading_rad;
      courses_[e.side] = {from_rad,
                          paths_[i].at(e.to_m).heading_rad - from_rad};
    }
  for (std::size_t i = 0; i < paths_.size(); ++i)
    for (const auto& name : map.lanes()[i].next) {
      next_[i].push_back(index.at(name));
      previous_[index.at(name)].push_back(i);
    }
}

void lane_network::cut() {
  assert(paths_.size() == half_widths_m_.size());
  cell_grid cells;
  std::vector<piece> pieces;
  for (std::size_t lane = 0; lane < paths_.size(); ++lane) {
    const auto& line = paths_[lane];
    const auto most_m = line.is_straight() ? straight_piece_m : piece_m;
    const auto count = std::ceil(line.length_m() / most_m);
    const auto step_m = line.length_m() / count;
    assert(count >= 1 && step_m > 0 && step_m <= most_m);
    for (auto i = 0.0; i < count; ++i) {
      const piece p{line.at(i * step_m).at, line.at((i + 1) * step_m).at,
                    (i + 0.5) * step_m, static_cast<std::uint32_t>(lane)};
      cells.add(p.from, p.to, half_widths_m_[lane],
                static_cast<cell_grid::item>(pieces.size()));
      pieces.push_back(p);
    }
  }
  pieces_ = {cells, [&pieces](cell_grid::item i) { return pieces[i]; }};
}

/// @returns whether a point is beside it, or beside the gap after or before it.
bool lane_network::piece::reaches(point p) const {
  const auto ahead = to - from;
  const auto length2_m2 = dot(ahead, ahead), along = dot(ahead, p - from);
  const auto beyond = std::max(-along, along - length2_m2); // times the length
  return beyond <= 0 || beyond * beyond <= wedge_m * wedge_m * length2_m2;
}

lane_network::placements lane_network::find(const oriented_box& body) const {
  assert(std::isfinite(body.heading_rad) && std::isfinite(body.centre.x_m)
         && std::isfinite(body.centre.y_m));
  const point along{std::cos(body.heading_rad), std::sin(body.heading_rad)};
  placements found;
  const piece* best = nullptr;
  auto best_m = 0.0;
  auto settle = [&] {
    if (best && found.count < found.all.size()) {
      const auto& line = paths_[best->lane];
      const auto on =
          line.project(body.centre, best->s_m,
                       line.is_straight() ? straight_piece_m : piece_m);
      found.all[found.count++] = {best->lane, on.s_m};
    }
    best = nullptr;
  };
  // The pieces of a cell come in the order of lanes.
  for (const auto& p : pieces_.at(body.centre)) {
    assert(!best || best->lane <= p.lane);
    const auto ahead = p.to - p.from;
    assert(dot(ahead, ahead) > 0);
    const auto c = dot(ahead, along);
    if (c < 0 || c * c < same_way * same_way * dot(ahead, ahead))
      continue;
    if (!p.reaches(body.centre))
      continue;
    const auto away_m = distance_to_segment_m(body.centre, p.from, p.to);
    if (away_m > half_widths_m_[p.lane])
      continue;
    if (best && best->lane != p.lane)
      settle();
    if (!best || away_m < best_m)
      best = &p, best_m = away_m;
  }
  settle();
  return found;
}

std::vector<point> lane_network::approach(std::uint32_t side,
                                          double within_s) const {
  assert(side < begins_.size() && within_s >= 0);
  std::vector<point> places;
  come(begins_[side].lane, begins_[side].s_m, within_s, places);
  return places;
}

/// @param s_m  From here on the lane back.
void lane_network::come(std::size_t lane, double s_m, double within_s,
                        std::vector<point>& out) const {
  constexpr auto apart_m = 4.0;
  assert(lane < paths_.size() && s_m <= paths_[lane].length_m());
  const auto limit_mps = limits_mps_[lane];
  assert(limit_mps > 0);
  for (auto way_m = 0.0; way_m <= within_s * limit_mps; way_m += apart_m) {
    if (way_m > s_m) {
      for (const auto before : previous_[lane])
        come(before, paths_[before].length_m(), within_s - way_m / limit_mps,
             out);
      return;
    }
    out.push_back(paths_[lane].at(s_m - way_m).at);
  }
}

void lane_network::foresee(const track& x, double within_m,
                           std::vector<conflict_visit>& out) const {
  assert(within_m >= 0 && within_m <= farthest_m);
  assert(x.length_m > 0);
  const driver who{x.length_m / 2, x.speed_mps(), std::max(within_m, at_line_m),
                   out.size(), out};
  const auto on = find(x.body());
  const auto is_likely = [&](const placement& p) {
    return takes(who, p.lane, -p.s_m) && stays_on(x, p);
  };
  const auto likely = std::ranges::count_if(on, is_likely);
  const auto several = likely > 1 || (likely == 0 && on.count > 1);
  for (const auto& [lane, s_m] : on) {
    if (likely > 0 && !is_likely({lane, s_m}))
      continue;
    drive(who, {lane, -s_m, several});
    if (s_m < who.half_length_m) // its rear is still there
      for (const auto before : previous_[lane])
        meet(who, {before, -s_m - paths_[before].length_m(), several});
  }
}

track lane_network::moved_along(track x, double way_m) const {
  assert(way_m >= 0 && std::isfinite(x.heading_rad));
  const auto turned = [&](const placement& on) {
    return std::abs(
        wrap_angle(x.heading_rad - paths_[on.lane].at(on.s_m).heading_rad));
  };
  const auto ahead = [](double heading_rad) {
    return point{std::cos(heading_rad), std::sin(heading_rad)};
  };
  const auto lanes = find(x.body());
  const auto on = std::ranges::min_element(lanes, {}, turned);
  auto straight_m = way_m;
  auto at = x.centre();
  if (on != lanes.end()) {
    const auto& path = paths_[on->lane];
    const auto along_m = std::min(way_m, path.length_m() - on->s_m);
    const auto here = path.at(on->s_m), there = path.at(on->s_m + along_m);
    const auto d_m = cross(ahead(here.heading_rad), at - here.at);
    straight_m -= along_m;
    x.heading_rad = there.heading_rad;
    const auto along = ahead(there.heading_rad);
    at = there.at + d_m * point{-along.y_m, along.x_m};
  }
  at = at + straight_m * ahead(x.heading_rad);
  const auto speed_mps = std::hypot(x.motion.mean(0, 1), x.motion.mean(1, 1));
  const auto along = ahead(x.heading_rad);
  assert(straight_m >= 0 && std::isfinite(at.x_m));
  x.motion.mean << at.x_m, speed_mps * along.x_m, at.y_m, speed_mps * along.y_m;
  x.rest.reset();
  return x;
}

/// @returns whether a body is on a lane still when it has gone straight on for
/// a little; else it is leaving it.
bool lane_network::stays_on(const track& x, const placement& on) const {
  constexpr auto straight_m = 5.0;
  const auto lane = paths_[on.lane].at(on.s_m);
  const auto to = x.centre() - lane.at;
  const point left{-std::sin(lane.heading_rad), std::cos(lane.heading_rad)};
  const auto d_m =
      dot(to, left) + straight_m * std::sin(x.heading_rad - lane.heading_rad);
  return std::abs(d_m) <= half_widths_m_[on.lane];
}

/// @returns whether a body may go along a lane, as fast as it is.
bool lane_network::takes(const driver& who, std::size_t lane,
                         double start_m) const {
  assert(lane < bends_.size());
  const auto& [s_m, speed_mps] = bends_[lane];
  const auto way_m = start_m + s_m;
  const auto v = who.speed_mps;
  return v * v <= speed_mps * speed_mps
                      + 2 * most_braking_mps2 * std::max(0.0, way_m)
         || way_m < -who.half_length_m; // it has gone through
}

void lane_network::meet(const driver& who, const lane_ahead& on) const {
  const auto& [lane, start_m, may_turn_off] = on;
  assert(lane < meetings_.size());
  assert(who.half_length_m > 0 && who.first <= who.out.size());
  for (const auto& e : meetings_[lane]) {
    const auto way_m = std::max(0.0, start_m + e.from_m - who.half_length_m);
    const auto left_m = start_m + e.to_m + who.half_length_m;
    const auto stands = who.speed_mps < stands_below_mps;
    if (e.how == world::conflict::kind::diverge || left_m <= 0
        || way_m > (stands ? at_line_m : who.within_m))
      continue;
    conflict_visit here{e.side, e.rank, way_m};
    here.sets_off = stands && way_m > 0;
    here.is_past = left_m < who.half_length_m;
    here.may_turn_off = may_turn_off;
    if (here.sets_off) {
      here.enter_s = standing_start_s(way_m);
      here.leave_s = standing_start_s(left_m);
    } else if (stands) {
      here.leave_s = std::numeric_limits<double>::infinity();
    } else {
      here.enter_s = enters_s(way_m, who.speed_mps);
      here.leave_s = left_m / who.speed_mps;
    }
    assert(here.way_m >= 0 && here.enter_s <= here.leave_s);
    const auto known = std::find_if(
        who.out.begin() + static_cast<std::ptrdiff_t>(who.first), who.out.end(),
        [&](const conflict_visit& a) { return a.side == e.side; });
    if (known == who.out.end()) {
      who.out.push_back(here);
    } else {
      known->way_m = std::min(known->way_m, here.way_m);
      known->is_past = known->is_past && here.is_past;
      known->may_turn_off = known->may_turn_off && may_turn_off;
      known->enter_s = std::min(known->enter_s, here.enter_s);
      known->leave_s = std::max(known->leave_s, here.leave_s);
    }
  }
}

void lane_network::drive(const driver& who, const lane_ahead& on) const {
  assert(on.lane < paths_.size());
  meet(who, on);
  const auto end_m = on.start_m + paths_[on.lane].length_m();
  assert(end_m > on.start_m); // or lanes that end in each other had no end
  if (end_m - who.half_length_m > who.within_m)
    return;
  const auto& all = next_[on.lane];
  const auto is_taken = [&](std::size_t next) {
    return takes(who, next, end_m);
  };
  const auto taken = std::ranges::count_if(all, is_taken);
  const auto several = taken > 1 || (taken == 0 && all.size() > 1);
  for (const auto following : all)
    if (taken == 0 || is_taken(following))
      drive(who, {following, end_m, on.may_turn_off || several});
}

} // namespace sofof::planners
