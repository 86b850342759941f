// Shapes, intervals and states as a CommonRoad file writes them.
#include "maps/commonroad_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sofof::maps {

namespace {

constexpr auto largest_m = 1000.0; // of a shape
constexpr auto last_step = 100000.0;
constexpr auto full_turns_rad = 100.0;
constexpr auto fastest_mps = 150.0;

bool is_shape(std::string_view name) {
  return name == "rectangle" || name == "circle" || name == "polygon";
}

point turned(point p, double by_rad) {
  const auto c = std::cos(by_rad), s = std::sin(by_rad);
  return {c * p.x_m - s * p.y_m, s * p.x_m + c * p.y_m};
}

} // namespace

std::vector<point> corners_of(const shape_box& box) {
  std::vector<point> all;
  for (const auto& [along, across] :
       {std::pair{1, 1}, std::pair{-1, 1}, std::pair{-1, -1}, std::pair{1, -1}})
    all.push_back(box.middle
                  + turned({along * box.length_m / 2, across * box.width_m / 2},
                           box.heading_rad));
  return all;
}

bool closed_interval::holds_angle(double angle_rad) const {
  constexpr auto turn_rad = 2 * std::numbers::pi;
  const auto turns = std::ceil((low - angle_rad) / turn_rad);
  return angle_rad + turns * turn_rad <= high;
}

bool scene_region::contains(point p) const {
  if (corners.empty())
    return distance_m(p, centre) <= radius_m;
  auto inside = false;
  auto a = corners.back();
  for (const auto b : corners) {
    constexpr auto on_rim_m = 1e-9;
    if (distance_to_segment_m(p, a, b) <= on_rim_m)
      return true;
    if ((a.y_m > p.y_m) != (b.y_m > p.y_m)
        && (cross(b - a, p - a) > 0) == (b.y_m > a.y_m))
      inside = !inside;
    a = b;
  }
  return inside;
}

pugi::xml_node commonroad_values::need(pugi::xml_node at,
                                       const char* name) const {
  const auto found = at.child(name);
  if (!found)
    file_.refuse(at, fmt::format("<{}> needs <{}>.", at.name(), name));
  return found;
}

double commonroad_values::number(pugi::xml_node at, const char* name,
                                 double least, double most) const {
  const auto found = need(at, name);
  return file_.to_number(found.child_value(), found, least, most);
}

point commonroad_values::place(pugi::xml_node at) const {
  return {number(at, "x"), number(at, "y")};
}

std::vector<point> commonroad_values::points(pugi::xml_node at,
                                             std::size_t least) const {
  constexpr std::size_t most = 10000;
  std::vector<point> all;
  for (const auto p : at.children("point"))
    all.push_back(place(p));
  if (all.size() < least || all.size() > most)
    file_.refuse(
        at, fmt::format("<{}> needs {} to {} points.", at.name(), least, most));
  return all;
}

closed_interval commonroad_values::interval(pugi::xml_node at, double least,
                                            double most) const {
  if (at.child("exact")) {
    const auto x = number(at, "exact", least, most);
    return {x, x};
  }
  const closed_interval made{number(at, "intervalStart", least, most),
                             number(at, "intervalEnd", least, most)};
  if (made.low > made.high)
    file_.refuse(at, fmt::format("<{}> ends before it begins.", at.name()));
  return made;
}

std::pair<time_step, time_step>
commonroad_values::steps(pugi::xml_node at) const {
  const auto time = interval(need(at, "time"), 0, last_step);
  return {static_cast<time_step>(std::ceil(time.low)),
          static_cast<time_step>(std::floor(time.high))};
}

shape_box commonroad_values::rectangle(pugi::xml_node shape) const {
  shape_box made{.middle = {},
                 .length_m = number(shape, "length", 0.01, largest_m),
                 .width_m = number(shape, "width", 0.01, largest_m)};
  if (shape.child("orientation"))
    made.heading_rad =
        number(shape, "orientation", -full_turns_rad, full_turns_rad);
  if (const auto centre = shape.child("center"))
    made.middle = place(centre);
  return made;
}

scene_region commonroad_values::region(pugi::xml_node shape) const {
  const std::string_view name = shape.name();
  if (name == "rectangle")
    return {.corners = corners_of(rectangle(shape)), .centre = {}};
  if (name == "polygon")
    return {.corners = points(shape, 3), .centre = {}};
  scene_region disc{.corners = {}, .centre = {}};
  disc.radius_m = number(shape, "radius", 0.01, largest_m);
  if (const auto centre = shape.child("center"))
    disc.centre = place(centre);
  return disc;
}

std::vector<scene_region> commonroad_values::regions(pugi::xml_node at) const {
  std::vector<scene_region> all;
  for (const auto shape : at.children())
    if (is_shape(shape.name()))
      all.push_back(region(shape));
  return all;
}

shape_box commonroad_values::box(pugi::xml_node shapes) const {
  const auto first = shapes.first_child();
  if (std::string_view{first.name()} == "rectangle" && !first.next_sibling())
    return rectangle(first);
  point low{1e9, 1e9}, high{-1e9, -1e9};
  const auto reach = [&](point p, double r_m) {
    low = {std::min(low.x_m, p.x_m - r_m), std::min(low.y_m, p.y_m - r_m)};
    high = {std::max(high.x_m, p.x_m + r_m), std::max(high.y_m, p.y_m + r_m)};
  };
  const auto all = regions(shapes);
  if (all.empty())
    file_.refuse(shapes, fmt::format("<{}> needs a <rectangle>, <circle> or "
                                     "<polygon>.",
                                     shapes.name()));
  for (const auto& one : all) {
    if (one.corners.empty())
      reach(one.centre, one.radius_m);
    for (const auto p : one.corners)
      reach(p, 0);
  }
  return {0.5 * (low + high), 0, std::max(high.x_m - low.x_m, 0.01),
          std::max(high.y_m - low.y_m, 0.01)};
}

scene_body::state commonroad_values::state(pugi::xml_node at) const {
  scene_body::state made;
  made.step = steps(at).first;
  const auto position = need(at, "position");
  made.at = position.child("point") ? place(position.child("point"))
                                    : box(position).middle;
  const auto middle = [](closed_interval x) { return (x.low + x.high) / 2; };
  if (const auto heading = at.child("orientation"))
    made.heading_rad =
        wrap_angle(middle(interval(heading, -full_turns_rad, full_turns_rad)));
  if (const auto speed = at.child("velocity"))
    made.speed_mps = middle(interval(speed, -fastest_mps, fastest_mps));
  return made;
}

} // namespace sofof::maps
