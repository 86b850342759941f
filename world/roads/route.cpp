// A way through the streets: lanes one after the other.
#include "world/roads/route.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace sofof::world {

namespace {

/// Where one lane ends and the next begins closer than this, it is one point.
constexpr auto same_point_m = 0.05;

/// The points of several lanes in a row.
struct chain {
  std::vector<point> points;
  std::vector<std::size_t> firsts; ///< Where each lane begins in `points`.

  chain(std::span<const lane> lanes, std::span<const std::size_t> sequence,
        bool closed) {
    for (const auto i : sequence) {
      auto centre = std::span{lanes[i].centre};
      if (!points.empty()
          && distance_m(points.back(), centre.front()) < same_point_m) {
        firsts.push_back(points.size() - 1);
        centre = centre.subspan(1);
      } else {
        firsts.push_back(points.size());
      }
      points.insert(points.end(), centre.begin(), centre.end());
    }
    if (closed && distance_m(points.back(), points.front()) < same_point_m)
      points.pop_back();
  }
};

} // namespace

route::route(std::string name, std::span<const lane> lanes,
             std::vector<std::size_t> sequence, bool closed,
             const lane_index& index)
    : name_{std::move(name)}, sequence_{std::move(sequence)} {
  assert(!sequence_.empty());
  assert(std::ranges::all_of(sequence_,
                             [&](std::size_t i) { return i < lanes.size(); }));
  const chain all{lanes, sequence_, closed};
  path_ = world::path{all.points, closed};
  for (const auto first : all.firsts)
    starts_m_.push_back(path_.knots_m()[first]);
  starts_m_.push_back(path_.length_m());
  for (const auto i : sequence_) {
    limits_.push_back(lanes[i].limits);
    half_widths_m_.push_back(lanes[i].half_width_m);
    left_m_.push_back(lanes[i].half_width_m);
    if (const auto beside = index.find(lanes[i].opposite);
        beside != index.end())
      left_m_.back() += 2 * lanes[beside->second].half_width_m;
  }
}

route::leg route::find_leg(double s_m) const {
  if (closed())
    s_m -= std::floor(s_m / length_m()) * length_m();
  const auto after =
      std::upper_bound(starts_m_.begin() + 1, starts_m_.end() - 1, s_m);
  const auto i = static_cast<std::size_t>(after - starts_m_.begin()) - 1;
  return {i, std::clamp(s_m, 0.0, length_m()) - starts_m_[i]};
}

route::place route::at_lane(double s_m) const {
  const auto [i, on_lane_m] = find_leg(s_m);
  return {sequence_[i], on_lane_m};
}

double route::limit_mps(double s_m) const {
  return bounds_at(s_m).limit_mps;
}

route::bounds route::bounds_at(double s_m) const {
  const auto [i, on_lane_m] = find_leg(s_m);
  const auto& zones = limits_[i];
  const auto after =
      std::ranges::upper_bound(zones, on_lane_m, {}, &speed_zone::from_m);
  const auto& zone = after == zones.begin() ? zones.front() : *std::prev(after);
  const auto lane_m = s_m - on_lane_m; // where it begins
  const auto lane_end_m = lane_m + starts_m_[i + 1] - starts_m_[i];
  return {half_widths_m_[i], zone.limit_mps, left_m_[i],
          lane_m + (after == zones.begin() ? 0 : zone.from_m),
          after == zones.end() ? lane_end_m
                               : std::min(lane_end_m, lane_m + after->from_m)};
}

double route::half_width_m(double s_m) const {
  return half_widths_m_[find_leg(s_m).index];
}

double route::left_m(double s_m) const {
  return left_m_[find_leg(s_m).index];
}

std::vector<point> route::waypoints(double s_m, double ahead_m,
                                    double spacing_m) const {
  std::vector<point> ahead;
  const auto end_m =
      closed() ? s_m + ahead_m : std::min(s_m + ahead_m, length_m());
  const auto steps = std::max(end_m - s_m, 0.0) / spacing_m;
  ahead.reserve(static_cast<std::size_t>(steps) + 2);
  for (auto i = 0.0; s_m + i * spacing_m < end_m; ++i)
    ahead.push_back(path_.at(s_m + i * spacing_m).at);
  ahead.push_back(path_.at(end_m).at);
  return ahead;
}

} // namespace sofof::world
