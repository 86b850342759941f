// Reads a map file for tests, without the checks of the real loader.
#pragma once

#include "world/roads/road_map.hpp"

#include <toml++/toml.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::test {

struct map_file {
  world::road_map map;
  std::vector<world::route_ptr> routes;

  /// @throws std::out_of_range when there is no such route.
  world::route_ptr route(std::string_view name) const {
    for (const auto& r : routes)
      if (r->name() == name)
        return r;
    throw std::out_of_range{"no route " + std::string{name}};
  }
};

inline std::vector<point> read_points(const toml::node_view<toml::node> list) {
  std::vector<point> points;
  for (auto& item : *list.as_array()) {
    const auto& xy = *item.as_array();
    points.push_back({*xy[0].value<double>(), *xy[1].value<double>()});
  }
  return points;
}

inline std::vector<std::string>
read_names(const toml::node_view<toml::node> list) {
  std::vector<std::string> names;
  if (!list)
    return names;
  for (auto& item : *list.as_array())
    names.push_back(*item.value<std::string>());
  return names;
}

inline world::lane read_lane(toml::table& t) {
  world::lane l{*t["name"].value<std::string>(),
                read_points(t["points_m"]),
                *t["half_width_m"].value<double>(),
                {},
                read_names(t["next"]),
                *t["rank"].value<int>()};
  for (auto& item : *t["limits"].as_array()) {
    auto& zone = *item.as_table();
    l.limits.push_back(
        {*zone["from_m"].value<double>(), *zone["limit_mps"].value<double>()});
  }
  return l;
}

/// @throws toml::parse_error, std::invalid_argument.
inline map_file read_map(const std::string& file) {
  auto root = toml::parse_file(file);
  std::vector<world::lane> lanes;
  for (auto& item : *root["lane"].as_array())
    lanes.push_back(read_lane(*item.as_table()));
  std::vector<world::building> buildings;
  if (root.contains("building"))
    for (auto& item : *root["building"].as_array())
      buildings.push_back({read_points((*item.as_table())["corners_m"])});
  world::geo_origin origin;
  if (auto anchor = root["origin"])
    origin = {
        *anchor["utm_e_m"].value<double>(), *anchor["utm_n_m"].value<double>(),
        *anchor["utm_zone"].value<int>(), *anchor["lat_deg"].value<double>(),
        *anchor["lon_deg"].value<double>()};
  map_file result{{*root["name"].value<std::string>(), origin, std::move(lanes),
                   std::move(buildings)},
                  {}};
  for (auto& item : *root["route"].as_array()) {
    auto& r = *item.as_table();
    result.routes.push_back(result.map.make_route(
        *r["name"].value<std::string>(), read_names(r["lanes"]),
        *r["closed"].value<bool>()));
  }
  return result;
}

} // namespace sofof::test
