// Lines of sight from all along a route.
#include "planners/scene/route_sight.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace sofof::planners {
namespace {

/// The centre line is looked at in these steps, m.
constexpr double look_step_m = 2;
/// So far ahead others tell what they see, at least; nobody needs more to stop.
constexpr double told_m = 200;
/// From so far before a crossing on, who comes is looked for.
constexpr double approach_m = 60;
constexpr double approach_step_m = 1;
/// Who comes within this time is seen in time, s.
constexpr double in_time_s = 4;
/// Sine of the least angle at which ways come from one side or the other.
constexpr double sideways_sine = 0.5;

} // namespace

route_sight::route_sight(world::route_ptr way, const line_of_sight& houses,
                         const eyes_on_road& eyes,
                         const world::vehicle_params& car)
    : way_{std::move(way)}, houses_{houses}, eyes_{eyes}, car_{car} {
  assert(way_ && eyes_.range_m >= 0);
}

bool route_sight::is_seen_from(const world::viewpoint& eye, point p) const {
  const auto to = p - eye.at;
  if (dot(to, to) > eye.range_m * eye.range_m)
    return false;
  const auto is_before_it = [&] {
    constexpr auto rad_per_deg = std::numbers::pi / 180;
    const auto off_rad =
        wrap_angle(std::atan2(to.y_m, to.x_m) - eye.heading_rad);
    return std::abs(off_rad) <= eye.field_of_view_deg / 2 * rad_per_deg;
  };
  return (eye.field_of_view_deg >= 360 || is_before_it())
         && (!eyes_.houses_hide || houses_.is_free(eye.at, p));
}

world::viewpoint route_sight::eye_at(double s_m) const {
  assert(std::isfinite(s_m));
  const auto axle = way_->path().at(s_m);
  const auto middle_m = (car_.front_m - car_.rear_m) / 2;
  const point ahead{std::cos(axle.heading_rad), std::sin(axle.heading_rad)};
  return {axle.at + middle_m * ahead, axle.heading_rad, eyes_.range_m,
          eyes_.field_of_view_deg};
}

bool route_sight::is_seen(point p, const world::viewpoint& eye) const {
  return is_seen_from(eye, p) || is_told(p);
}

bool route_sight::is_told(point p) const {
  assert(std::isfinite(p.x_m) && std::isfinite(p.y_m));
  return std::ranges::any_of(
      eyes_.roadside, [&](const auto& eye) { return is_seen_from(eye, p); });
}

double route_sight::ahead_m(double s_m) const {
  const auto front_m = s_m + car_.front_m;
  assert(car_.front_m > 0 && look_step_m > 0);
  assert(std::isfinite(s_m));
  const auto most_m =
      eyes_.roadside.empty() ? eyes_.range_m : std::max(eyes_.range_m, told_m);
  const auto end_m = way_->closed()
                         ? front_m + most_m
                         : std::min(front_m + most_m, way_->length_m());
  auto seen_m = front_m;
  const auto eye = eye_at(s_m);
  while (seen_m < end_m
         && is_seen(way_->path().at(seen_m + look_step_m).at, eye))
    seen_m += look_step_m;
  assert(seen_m >= front_m);
  // Whoever is on an open route's end has left.
  if (!way_->closed() && seen_m >= end_m)
    return most_m;
  return seen_m - front_m;
}

std::vector<blind_corner>
route_sight::corners(const lane_network& lanes) const {
  std::vector<blind_corner> found;
  const world::unrolled_route zones{way_, lanes.meetings()};
  zones.for_zones(0, way_->length_m(), [&](const world::zone& z) {
    assert(z.from_m <= z.to_m);
    const auto other = lanes.rank(z.other_side());
    const auto those = lanes.approach(z.other_side(), in_time_s);
    if (other > z.rank || those.size() < 2)
      return true;
    const auto own_rad = way_->path().at(z.from_m).heading_rad;
    const auto they_rad = lanes.course_of(z.other_side()).from_rad;
    if (other == z.rank && std::sin(they_rad - own_rad) < sideways_sine)
      return true;
    const auto corner = look_at(z.from_m - car_.front_m, those);
    if (corner.seen_from_m > corner.line_m - approach_m)
      found.push_back(corner);
    return true;
  });
  add_long_ones(zones, found);
  std::ranges::sort(found, {}, &blind_corner::line_m);
  assert(std::ranges::all_of(
      found, [](const auto& x) { return x.seen_from_m <= x.line_m; }));
  return found;
}

/// Adds where crossings begin that belong together and end out of reach.
void route_sight::add_long_ones(const world::unrolled_route& zones,
                                std::vector<blind_corner>& found) const {
  assert(eyes_.range_m >= 0 && car_.rear_m >= 0);
  const auto reach_m = eyes_.range_m + (car_.front_m - car_.rear_m) / 2;
  auto from_m = 0.0, to_m = 0.0;
  const auto add = [&] {
    const blind_corner corner{from_m - car_.front_m, to_m - reach_m};
    if (to_m > from_m && !is_told(way_->path().at(to_m).at)
        && corner.seen_from_m > corner.line_m - approach_m)
      found.push_back(
          {corner.line_m, std::min(corner.seen_from_m, corner.line_m)});
  };
  zones.for_zones(0, way_->length_m(), [&](const world::zone& z) {
    if (z.from_m >= to_m + car_.front_m + car_.rear_m) {
      add();
      from_m = z.from_m;
    }
    to_m = std::max(to_m, z.to_m);
    assert(from_m <= to_m);
    return true;
  });
  add();
}

/// @param those  Places of who comes, from the crossing back.
blind_corner route_sight::look_at(double line_m,
                                  std::span<const point> those) const {
  blind_corner corner{line_m, line_m};
  assert(!those.empty());
  for (auto s = line_m; s > line_m - approach_m; s -= approach_step_m) {
    const auto eye = eye_at(s);
    if (!std::ranges::all_of(those, [&](point p) { return is_seen(p, eye); }))
      break;
    corner.seen_from_m = s - approach_step_m;
  }
  assert(corner.seen_from_m <= corner.line_m);
  return corner;
}

} // namespace sofof::planners
