// What a sensor sees of the bodies on the road.
#include "world/sensing/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sofof::world {

namespace {

constexpr double cell_m = 50;

/// @returns on which side of the line from `a` to `b` a point is.
bool is_left(point a, point b, point p) {
  return cross(b - a, p - a) > 0;
}

/// @returns whether the line from `a` to `b` meets the rim. Points on a line
/// count as right of it, so that no gap is left at a corner.
bool meets(std::span<const point> rim, point a, point b) {
  auto from = rim.back();
  auto was_left = is_left(a, b, from);
  for (const auto to : rim) {
    const auto left = is_left(a, b, to);
    if (left != was_left && is_left(from, to, a) != is_left(from, to, b))
      return true;
    from = to;
    was_left = left;
  }
  return false;
}

std::array<point, 4> corners_of(const oriented_box& box) {
  const point along{std::cos(box.heading_rad), std::sin(box.heading_rad)};
  const auto forward = box.length_m / 2 * along;
  const auto left = box.width_m / 2 * point{-along.y_m, along.x_m};
  const auto front = box.centre + forward, rear = box.centre - forward;
  return {front + left, rear + left, rear - left, front - left};
}

double radius_of(point middle, std::span<const point> rim) {
  double radius_m = 0;
  for (const auto p : rim)
    radius_m = std::max(radius_m, distance_m(middle, p));
  return radius_m;
}

/// @returns the middle of the bounding box.
point middle_of(std::span<const point> rim) {
  const auto [west, east] = std::ranges::minmax_element(rim, {}, &point::x_m);
  const auto [south, north] = std::ranges::minmax_element(rim, {}, &point::y_m);
  return {(west->x_m + east->x_m) / 2, (south->y_m + north->y_m) / 2};
}

bool covers(const oriented_box& box, point p) {
  return overlap(box, {p});
}

bool is_in_field(const sensor& s, point p) {
  if (s.can.field_of_view_deg >= 360)
    return true;
  const auto d = p - s.at;
  const auto off_rad = wrap_angle(std::atan2(d.y_m, d.x_m) - s.heading_rad);
  return std::abs(off_rad)
         <= s.can.field_of_view_deg / 2 * std::numbers::pi / 180;
}

perceived_object measure(const road_body& body, const sensor& s,
                         time_point now) {
  const auto noise = s.noise.part(body.id.value());
  const auto when = static_cast<std::uint64_t>(now.time_since_epoch().count());
  enum measured : std::uint32_t { east, north, along, turn };
  const auto err = [&](double sd, measured what) {
    return noise.normal(0, sd, when, what);
  };
  const auto& box = body.box;
  return {box.centre
              + point{err(s.can.position_noise_m, east),
                      err(s.can.position_noise_m, north)},
          wrap_angle(box.heading_rad + err(s.can.heading_noise_rad, turn)),
          body.speed_mps + err(s.can.speed_noise_mps, along),
          body.accel_mps2,
          box.length_m,
          box.width_m};
}

} // namespace

scene::scene(std::span<const building> buildings)
    : house_cells_{cell_m}, body_cells_{cell_m} {
  for (const auto& b : buildings) {
    house h;
    h.shape = polygon{b.corners};
    h.middle = middle_of(b.corners);
    h.radius_m = radius_of(h.middle, b.corners);
    largest_house_m_ = std::max(largest_house_m_, h.radius_m);
    house_cells_.add(h.middle, h.middle, 0,
                     static_cast<cell_grid::item>(houses_.size()));
    houses_.push_back(std::move(h));
  }
}

void scene::place(std::span<const road_body> bodies) {
  bodies_.clear();
  body_cells_.clear();
  largest_body_m_ = 0;
  for (const auto& b : bodies) {
    const auto middle = b.box.centre;
    const auto radius_m = 0.5 * std::hypot(b.box.length_m, b.box.width_m);
    largest_body_m_ = std::max(largest_body_m_, radius_m);
    body_cells_.add(middle, middle, 0,
                    static_cast<cell_grid::item>(bodies_.size()));
    bodies_.push_back({{middle, radius_m}, b, corners_of(b.box)});
  }
}

/// All round one sensor that can be seen or hide something.
struct scene::outlook {
  struct neighbour {
    const vehicle* who;
    double distance_m;
  };
  struct screen {
    const solid* what;
    std::span<const point> rim;
  };

  const sensor* from;
  std::vector<neighbour> in_range; // the nearest first
  std::vector<screen> screens;

  bool is_clear(point p, const solid& target) const {
    return std::ranges::none_of(screens, [&](const screen& s) {
      return s.what != &target
             && distance_to_segment_m(s.what->middle, from->at, p)
                    <= s.what->radius_m
             && meets(s.rim, from->at, p);
    });
  }

  bool is_visible(const vehicle& v) const {
    const auto shows = [&](point p) {
      return is_in_field(*from, p) && is_clear(p, v);
    };
    return shows(v.middle) || std::ranges::any_of(v.corners, shows);
  }
};

scene::outlook scene::look_round(const sensor& s) const {
  outlook all{&s, {}, {}};
  // A line to the far corner of a body at the rim of the range may pass
  // somebody whose middle is still farther away.
  const auto reach_m = s.can.range_m + largest_body_m_;
  body_cells_.for_each_near(
      s.at, reach_m + largest_body_m_, [&](cell_grid::item i) {
        const auto& v = bodies_[i];
        if (s.carrier == v.is.id)
          return;
        const auto far_m = distance_m(s.at, v.middle);
        if (far_m <= s.can.range_m)
          all.in_range.push_back({&v, far_m});
        if (s.can.occlusion && far_m - v.radius_m <= reach_m
            && !(far_m <= v.radius_m && covers(v.is.box, s.at)))
          all.screens.push_back({&v, v.corners});
      });
  std::ranges::sort(all.in_range, [](const auto& a, const auto& b) {
    return std::pair{a.distance_m, a.who->is.id}
           < std::pair{b.distance_m, b.who->is.id};
  });
  if (s.can.occlusion && !houses_.empty())
    house_cells_.for_each_near(
        s.at, reach_m + largest_house_m_, [&](cell_grid::item i) {
          const auto& h = houses_[i];
          if (distance_m(s.at, h.middle) - h.radius_m <= reach_m
              && !h.shape.contains(s.at))
            all.screens.push_back({&h, h.shape.corners()});
        });
  return all;
}

std::vector<perceived_object> scene::seen_by(const sensor& s,
                                             time_point now) const {
  const auto all = look_round(s);
  std::vector<perceived_object> seen;
  for (const auto& n : all.in_range)
    if (all.is_visible(*n.who))
      seen.push_back(measure(n.who->is, s, now));
  return seen;
}

} // namespace sofof::world
