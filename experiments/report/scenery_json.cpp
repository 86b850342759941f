// Streets, houses and areas as numbers.
#include "experiments/report/scenery_json.hpp"

#include "experiments/report/delta_encoding.hpp"
#include "world/roads/path.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace sofof::experiments::report {

namespace {

using nlohmann::json;

constexpr int street_places = 2; // of metres

json corners_json(std::span<const point> corners) {
  auto all = json::array();
  for (const auto& p : corners)
    all.push_back({p.x_m, p.y_m});
  return all;
}

std::array<point, 4> corners_of(const oriented_box& box) {
  const point along{std::cos(box.heading_rad), std::sin(box.heading_rad)};
  const auto half_length = box.length_m / 2 * along;
  const auto half_width = box.width_m / 2 * point{-along.y_m, along.x_m};
  return {box.centre + half_length + half_width,
          box.centre - half_length + half_width,
          box.centre - half_length - half_width,
          box.centre + half_length - half_width};
}

/// Points of a lane's smooth line, closer together where it bends.
std::vector<point> line_of(const world::lane& of) {
  constexpr double bend_rad = 0.05; // between two points
  constexpr double most_pieces = 32;
  const world::path smooth{of.centre};
  const auto knots = smooth.knots_m();
  std::vector<point> points{smooth.at(knots.front()).at};
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const auto from_m = knots[i - 1];
    const auto length_m = knots[i] - from_m;
    const auto turn_rad = std::abs(smooth.at(knots[i]).heading_rad
                                   - smooth.at(from_m).heading_rad);
    const auto pieces =
        std::clamp(std::ceil(turn_rad / bend_rad), 1.0, most_pieces);
    for (double k = 1; k <= pieces; ++k)
      points.push_back(smooth.at(from_m + length_m * k / pieces).at);
  }
  return points;
}

json lanes_json(const world::road_map& map) {
  std::vector<double> counts, half_widths_m, x_m, y_m;
  for (const auto& one : map.lanes()) {
    const auto points = line_of(one);
    counts.push_back(static_cast<double>(points.size()));
    half_widths_m.push_back(one.half_width_m);
    for (const auto& p : points) {
      x_m.push_back(p.x_m);
      y_m.push_back(p.y_m);
    }
  }
  return {{"counts", delta_encoding(counts, 0)},
          {"half_widths", delta_encoding(half_widths_m, street_places)},
          {"x", delta_encoding(x_m, street_places)},
          {"y", delta_encoding(y_m, street_places)}};
}

json houses_json(const scenario::scenario_definition& what) {
  auto all = json::array();
  for (const auto& house : what.world->map.buildings())
    all.push_back(corners_json(house.corners));
  return all;
}

json obstacles_json(const scenario::scenario_definition& what) {
  auto all = json::array();
  for (const auto& one : what.obstacles)
    if (!one.moves()) // which is elsewhere soon
      all.push_back(corners_json(corners_of(one.box())));
  return all;
}

json providers_json(const scenario::scenario_definition& what) {
  auto all = json::array();
  for (const auto& one : what.providers) {
    auto sensors = json::array();
    for (const auto& sensor : one.sensors)
      sensors.push_back({sensor.position_m.x_m, sensor.position_m.y_m});
    all.push_back({{"name", one.name},
                   {"at", {one.position_m.x_m, one.position_m.y_m}},
                   {"area", corners_json(one.area().corners())},
                   {"sensors", std::move(sensors)}});
  }
  return all;
}

} // namespace

json scenery_json(const scenario::scenario_definition& what) {
  return {{"lanes", lanes_json(what.world->map)},
          {"houses", houses_json(what)},
          {"obstacles", obstacles_json(what)},
          {"providers", providers_json(what)}};
}

} // namespace sofof::experiments::report
